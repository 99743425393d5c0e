#include "canopeer/config/cost_table_file.h"

#include <cstdio>
#include <string>

#include "canopeer/config/yaml_reader.h"

namespace canopeer {

Expected<CostTable> load_cost_table(const std::filesystem::path& path) {
  auto file = YamlMap::load(path);
  if (!file) return tl::unexpected(file.error());
  YamlMap seconds = file->required_map("seconds_per_unit");
  CostTable table;
  for (std::size_t i = 0; i < kWorkKinds; ++i) {
    const auto kind = static_cast<Work>(i);
    // Tables of earlier versions do not have these: the fruit map cost nothing, and nobody solved
    // integer programs.
    const bool may_lack = kind == Work::fruit_frame || kind == Work::simplex_row;
    table[kind] = may_lack ? seconds.number(work_name(kind), 0.0, {0.0, 1000.0})
                           : seconds.required_number(work_name(kind), {0.0, 1000.0});
  }
  if (auto done = file->finish(); !done) return tl::unexpected(done.error());
  return table;
}

std::string cost_table_text(const CostTable& table, std::string_view comment) {
  std::string text = "# " + std::string(comment) + "\nseconds_per_unit:\n";
  for (std::size_t i = 0; i < kWorkKinds; ++i) {
    const auto kind = static_cast<Work>(i);
    char number[32];
    std::snprintf(number, sizeof number, "%.3g", table[kind]);
    text += "  " + std::string(work_name(kind)) + ": " + number + "\n";
  }
  return text;
}

}  // namespace canopeer
