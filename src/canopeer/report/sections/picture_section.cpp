#include <fmt/format.h>

#include "canopeer/report/drawing/base64.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {

std::string picture_section(const ReportData& data) {
  std::string html;
  for (const ReportPicture& picture : data.files.pictures) {
    const std::string caption = escape_html(picture.caption);
    html += fmt::format(
        "<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption>"
        "</figure>\n",
        caption, base64(picture.png_bytes), caption);
  }
  if (html.empty()) return {};
  return html_section("Pictures", "<div class=\"pictures\">\n" + html + "</div>\n");
}

}  // namespace canopeer
