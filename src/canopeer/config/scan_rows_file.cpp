#include "canopeer/config/scan_rows_file.h"

#include "canopeer/config/imported_world.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/geometry/angles.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

ColorRange read_color(YamlMap map) {
  ColorRange range;
  range.hue_low_deg = map.number("hue_low_deg", range.hue_low_deg, {-180.0, 360.0});
  range.hue_high_deg = map.number("hue_high_deg", range.hue_high_deg, {-180.0, 360.0});
  range.min_saturation = map.number("min_saturation", range.min_saturation, {0.0, 1.0});
  range.min_value = map.number("min_value", range.min_value, {0.0, 1.0});
  if (range.hue_high_deg < range.hue_low_deg) {
    map.complain("hue_high_deg", "expected at least hue_low_deg; red is from -25 to 30, say");
  }
  return range;
}

PlantScan read_scan(YamlMap& map, const fs::path& folder) {
  PlantScan scan;
  scan.name = map.required_text("name");
  scan.mesh = folder / map.required_text("mesh");
  if (map.has("fruit_color")) scan.fruit_color = read_color(map.map("fruit_color"));
  if (map.has("counted_color")) scan.counted_color = read_color(map.map("counted_color"));
  if (map.has("fruit_mesh")) scan.fruit_mesh = folder / map.required_text("fruit_mesh");
  read_name_patterns(map, scan.patterns);
  scan.unit_m = map.number("unit_m", scan.unit_m, {1e-6, 1e3});
  scan.y_up = map.choice("up_axis", "z", {"z", "y"}) == "y";
  scan.ground = map.choice("origin", "foot", {"foot", "keep"}) == "foot";
  if (!scan.fruit_color && scan.fruit_mesh.empty() && scan.patterns.fruit.empty()) {
    map.complain("mesh", "which surface is fruit? Expected fruit_color, fruit_mesh or fruit");
  }
  return scan;
}

/// Index of a scan by name.
int scan_of(YamlMap& map, const std::string& key, const std::string& name,
            const std::vector<PlantScan>& scans) {
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].name == name) return static_cast<int>(i);
  }
  std::string known;
  for (const PlantScan& scan : scans) known += (known.empty() ? "" : ", ") + scan.name;
  map.complain(key, "expected the name of a scan (" + known + "), found '" + name + "'");
  return 0;
}

/// `count` plants along y, taking the row's scans in turn.
void read_scan_row(YamlMap& row, ScanRowsOptions& options) {
  const double x = row.required_number("x_m", {-1000, 1000});
  const double y = row.required_number("y_from_m", {-1000, 1000});
  const double z = row.number("z_m", 0.0, {-100, 100});
  const double spacing = row.required_number("spacing_m", {0.01, 100});
  const int count = row.required_integer("count", 1, 10000);
  const double yaw = row.number("yaw_deg", 0.0, {-360, 360}) * kDegree;
  const double yaw_step = row.number("yaw_step_deg", 0.0, {-360, 360}) * kDegree;
  std::vector<int> turn;
  for (const std::string& name : row.text_or_texts("scans", {})) {
    turn.push_back(scan_of(row, "scans", name, options.scans));
  }
  if (turn.empty()) row.complain("scans", "expected the name of a scan or a list of names");
  for (int i = 0; i < count && !turn.empty(); ++i) {
    options.plants.push_back({turn[static_cast<std::size_t>(i) % turn.size()],
                              Vec3(x, y + i * spacing, z), yaw + i * yaw_step});
  }
}

void read_plant(YamlMap& plant, ScanRowsOptions& options) {
  ScanPlacement placement;
  placement.scan = scan_of(plant, "scan", plant.required_text("scan"), options.scans);
  placement.position =
      Vec3(plant.required_number("x_m", {-1000, 1000}), plant.required_number("y_m", {-1000, 1000}),
           plant.number("z_m", 0.0, {-100, 100}));
  placement.yaw_rad = plant.number("yaw_deg", 0.0, {-360, 360}) * kDegree;
  options.plants.push_back(placement);
}

Expected<ScanRowsOptions> read(YamlMap file, const fs::path& path) {
  ScanRowsOptions options;
  options.name = file.text("name", path.stem().string());
  for (YamlMap& scan : file.maps("scans")) {
    options.scans.push_back(read_scan(scan, path.parent_path()));
  }
  for (YamlMap& row : file.maps("rows")) read_scan_row(row, options);
  for (YamlMap& plant : file.maps("plants")) read_plant(plant, options);
  options.floor = file.boolean("floor", options.floor);
  read_fruit_sizes(file, options.fruits);
  if (options.scans.empty()) file.complain("scans", "expected at least one scan");
  if (options.plants.empty()) file.complain("rows", "expected a plant in rows or in plants");
  if (auto done = file.finish(); !done) return tl::unexpected(done.error());
  return options;
}

}  // namespace

bool is_scan_rows_file(const fs::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

Expected<ScanRowsOptions> load_scan_rows(const fs::path& path) {
  auto file = YamlMap::load(path);
  if (!file) return tl::unexpected(file.error());
  return read(*file, path);
}

Expected<ScanRowsOptions> parse_scan_rows(std::string_view text, const std::string& name) {
  auto file = YamlMap::parse(text, name);
  if (!file) return tl::unexpected(file.error());
  return read(*file, name);
}

}  // namespace canopeer
