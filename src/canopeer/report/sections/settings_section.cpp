#include <nlohmann/json.hpp>

#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {

std::string settings_section(const ReportData& data) {
  const std::string& settings = data.files.record.header.settings_json;
  const auto json = nlohmann::ordered_json::parse(settings, nullptr, false);
  const std::string text = json.is_discarded() ? settings : json.dump(2);
  if (text.empty()) return {};
  return html_details("Settings", "<pre>" + escape_html(text) + "</pre>\n");
}

}  // namespace canopeer
