#include "canopeer/config/imported_world.h"

#include "canopeer/config/scan_rows_file.h"

namespace canopeer {

void read_name_patterns(YamlMap& map, NamePatternOptions& options) {
  for (const auto& [key, value] :
       {std::pair{"fruit", &options.fruit}, std::pair{"counted", &options.counted},
        std::pair{"leaf", &options.leaf}, std::pair{"stem", &options.stem},
        std::pair{"plant", &options.plant}, std::pair{"skip", &options.skip}}) {
    *value = map.text(key, *value);
    NamePatternOptions alone;
    alone.fruit = *value;
    if (auto ok = NamePatterns::compile(alone); !ok) {
      map.complain(key, "expected a regular expression, found '" + *value + "'");
    }
  }
}

void read_fruit_sizes(YamlMap& map, FruitComponentOptions& options) {
  options.min_hull_cm3 = map.number("min_fruit_cm3", options.min_hull_cm3, {0.0, 1e6});
  options.weld_tolerance_m =
      map.number("weld_mm", options.weld_tolerance_m * 1e3, {1e-4, 10.0}) / 1e3;
}

Expected<void> read_imported_world(YamlMap& world, WorldSource& source) {
  const std::filesystem::path folder = world.directory();
  const std::filesystem::path file = folder / world.required_text("import");
  if (is_scan_rows_file(file)) {
    auto rows = load_scan_rows(file);
    if (!rows) return tl::unexpected(rows.error());
    source.scans = std::move(*rows);
    return {};
  }
  WorldImportOptions& options = source.import;
  options.file = file;
  for (const std::string& path : world.text_or_texts("model_path", {})) {
    options.model_paths.push_back(folder / path);
  }
  read_name_patterns(world, options.patterns);
  read_fruit_sizes(world, options.fruits);
  options.honour_up_axis = world.choice("dae_up_axis", "honour", {"honour", "ignore"}) == "honour";
  return {};
}

}  // namespace canopeer
