#include "canopeer/config/cost_table_file.h"

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
    table[kind] = seconds.required_number(work_name(kind), {0.0, 1000.0});
  }
  if (auto done = file->finish(); !done) return tl::unexpected(done.error());
  return table;
}

}  // namespace canopeer
