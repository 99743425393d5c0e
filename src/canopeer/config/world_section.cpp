#include "canopeer/config/world_section.h"

#include <cmath>

#include "canopeer/config/imported_world.h"
#include "canopeer/geometry/angles.h"
#include "canopeer/scene/scene_file.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

constexpr int kMostPlants = 20000;

PlantPreset read_plant_preset(YamlMap& map, PlantPreset fallback) {
  if (!map.has("preset")) return fallback;
  const std::string name = map.choice("preset", "paper", {"paper", "dense", "seedling"});
  if (name == "dense") return PlantPreset::dense;
  return name == "seedling" ? PlantPreset::seedling : PlantPreset::paper;
}

void read_plants(YamlMap& world, WorldOptions& options) {
  for (YamlMap& plant : world.maps("plants")) {
    PlantPlacement placement;
    placement.preset = read_plant_preset(plant, PlantPreset::numbered);
    if (placement.preset == PlantPreset::numbered) {
      placement.kind = plant.required_integer("kind", 1, 9);
    }
    placement.position =
        Vec3(plant.required_number("x_m", {-100, 100}), plant.required_number("y_m", {-1000, 1000}),
             plant.number("z_m", 0.0, {-10, 10}));
    placement.yaw_rad = plant.number("yaw_deg", 0.0, {-360, 360}) * kDegree;
    options.plants.push_back(placement);
  }
}

void read_row(YamlMap& map, WorldOptions& options) {
  PlantedRow row;
  row.x_m = map.required_number("x_m", {-100, 100});
  row.y_from_m = map.number("y_from_m", row.y_from_m, {-1000, 1000});
  row.spacing_m = map.number("spacing_m", row.spacing_m, {0.05, 100});
  row.count = map.integer("count", row.count, 1, kMostPlants);
  row.preset = read_plant_preset(map, PlantPreset::paper);
  for (const double kind : map.numbers("kinds", {}, 0, {1, 9})) {
    row.kinds.push_back(static_cast<int>(kind));
    if (kind != std::floor(kind)) map.complain("kinds", "expected whole numbers from 1 to 9");
  }
  if (!row.kinds.empty()) row.preset = PlantPreset::numbered;
  // Every level above the first one stands on a board.
  const double board_width = map.number("board_width_m", 0.25, {0.05, 5.0});
  const auto levels = map.numbers("levels_m", {0.0}, 0, {0.0, 20.0});
  for (std::size_t i = 0; i < levels.size(); ++i) {
    row.z_m = levels[i];
    add_row(row, &options);
    if (i == 0) continue;
    constexpr double kThickness = 0.01;
    const double half = 0.5 * board_width;
    const double last = row.y_from_m + row.spacing_m * (row.count - 1);
    options.boards.emplace_back(Vec3(row.x_m - half, row.y_from_m - 0.25, levels[i] - kThickness),
                                Vec3(row.x_m + half, last + 0.25, levels[i]));
  }
}

void read_furniture(YamlMap& world, WorldOptions& o) {
  o.walls = world.boolean("walls", o.walls);
  o.floor = world.boolean("floor", o.floor);
  o.strings = world.boolean("strings", o.strings);
  o.gutters = world.boolean("gutters", o.gutters);
  o.wall_x_m = world.number("wall_x_m", o.wall_x_m, {1.5, 100});
  o.wall_height_m = world.number("wall_height_m", o.wall_height_m, {0.1, 20});
  const auto along = world.numbers("along_y_m", {o.low_y_m, o.high_y_m}, 2, {-1000, 1000});
  o.low_y_m = along[0];
  o.high_y_m = along[1];
  if (o.low_y_m >= o.high_y_m) world.complain("along_y_m", "expected [low, high] with low < high");
  o.pipes = world.boolean("pipes", o.pipes);
  o.pipe_x_m = world.numbers("pipe_x_m", o.pipe_x_m, 0, {-100, 100});
  o.distractors = world.integer("distractors", o.distractors, 0, 1000);
  o.copies = world.integer("copies", o.copies, 0, 1000);
  o.ground_per_plant_m2 = world.number("ground_per_plant_m2", o.ground_per_plant_m2, {1e-3, 100});
}

void read_generated_world(YamlMap& world, WorldOptions& options) {
  options = *named_world(world.choice("preset", "scenario_1", world_names()));
  options.name = world.text("name", options.name);
  if (world.has("plants") || world.has("rows")) {
    options.plants.clear();
    options.boards.clear();
  }
  read_plants(world, options);
  for (YamlMap& row : world.maps("rows")) read_row(row, options);
  if (options.plants.size() > static_cast<std::size_t>(kMostPlants)) {
    world.complain("rows", "expected at most " + std::to_string(kMostPlants) + " plants in all");
    options.plants.clear();
  }
  read_furniture(world, options);
}

}  // namespace

Expected<void> read_world(YamlMap world, WorldSource& source) {
  if (world.has("import")) return read_imported_world(world, source);
  if (world.has("scene")) {
    const std::filesystem::path path = world.directory() / world.text("scene", "");
    if (is_frozen_scene(path)) {
      source.import.file = path;
      return {};
    }
    auto file = load_scene_file(path);
    if (!file) return tl::unexpected(file.error());
    source = std::move(file->world);
    return {};
  }
  read_generated_world(world, source.generated);
  return {};
}

Expected<SceneFile> load_scene_file(const std::filesystem::path& path) {
  if (is_frozen_scene(path)) {
    SceneFile frozen;
    frozen.world.import.file = path;
    return frozen;
  }
  auto yaml = YamlMap::load(path);
  if (!yaml) return tl::unexpected(yaml.error());
  SceneFile file;
  file.seed = static_cast<std::uint64_t>(yaml->number("seed", 1, {0, 9007199254740992.0}));
  if (yaml->has("import")) {
    if (auto ok = read_imported_world(*yaml, file.world); !ok) return tl::unexpected(ok.error());
  } else {
    read_generated_world(*yaml, file.world.generated);
  }
  if (!yaml->has("name")) file.world.generated.name = path.stem().string();
  if (auto done = yaml->finish(); !done) return tl::unexpected(done.error());
  return file;
}

bool is_scene_file(const std::filesystem::path& path) {
  if (is_frozen_scene(path)) return true;
  auto yaml = YamlMap::load(path);
  return yaml && !yaml->has("robot") && !yaml->has("stops_travel_m");
}

}  // namespace canopeer
