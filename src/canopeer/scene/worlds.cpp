#include "canopeer/scene/worlds.h"

#include <array>

namespace canopeer {
namespace {

constexpr std::array<int, 6> kLeft = {4, 9, 8, 7, 5, 6};   // x = −0.75
constexpr std::array<int, 6> kRight = {5, 1, 7, 6, 2, 3};  // x = +0.75
constexpr double kRowX = 0.75;
constexpr double kFirstY = -1.25;
constexpr double kSpacing = 0.5;
constexpr double kRowPitch = 1.5;  // ground of a row from the middle of one path to the next

/// The paper's twelve plants, on the floor or on boards.
void add_level(double z, WorldOptions* options) {
  for (std::size_t i = 0; i < kLeft.size(); ++i) {
    const double lift = kLeft[i] == 6 ? 0.05 : 0.0;
    options->plants.push_back(
        {kLeft[i], Vec3(-kRowX, kFirstY + kSpacing * static_cast<double>(i), z + lift), 0.0});
  }
  for (std::size_t i = 0; i < kRight.size(); ++i) {
    options->plants.push_back(
        {kRight[i], Vec3(kRowX, kFirstY + kSpacing * static_cast<double>(i), z), 0.0});
  }
}

/// Two rows with gutters.
WorldOptions crop(const std::string& name, PlantPreset preset, int count, double spacing) {
  WorldOptions options;
  options.name = name;
  for (const double x : {-kRowX, kRowX}) {
    add_row({x, kFirstY, spacing, count, 0.08, preset, {}}, &options);
  }
  options.gutters = true;
  options.wall_height_m = 3.4;
  options.high_y_m = kFirstY + spacing * count + 3.0;
  options.ground_per_plant_m2 = spacing * kRowPitch;
  return options;
}

}  // namespace

void add_row(const PlantedRow& row, WorldOptions* options) {
  for (int i = 0; i < row.count; ++i) {
    PlantPlacement placement;
    if (!row.kinds.empty()) {
      placement.kind = row.kinds[static_cast<std::size_t>(i) % row.kinds.size()];
    }
    placement.position = Vec3(row.x_m, row.y_from_m + row.spacing_m * i, row.z_m);
    placement.preset = row.preset;
    options->plants.push_back(placement);
  }
}

WorldOptions scenario_1_world() {
  WorldOptions options;
  options.name = "scenario_1";
  add_level(0.0, &options);
  return options;
}

WorldOptions scenario_2_world() {
  constexpr double kBoard = 1.25;
  WorldOptions options;
  options.name = "scenario_2";
  options.distractors = 48;
  add_level(0.0, &options);
  add_level(kBoard, &options);
  for (const double x : {-kRowX, kRowX}) {
    // 0.25 × 3 × 0.01 m under the upper plants.
    options.boards.emplace_back(Vec3(x - 0.125, -1.5, kBoard - 0.01), Vec3(x + 0.125, 1.5, kBoard));
  }
  return options;
}

WorldOptions dense_1_world() { return crop("dense_1", PlantPreset::dense, 6, 0.5); }

WorldOptions dense_2_world() { return crop("dense_2", PlantPreset::dense, 10, 0.4); }

WorldOptions row_100m_world() {
  WorldOptions options;
  options.name = "row_100m";
  for (const double x : {-kRowX, kRowX}) {
    // The first 21 are those that are grown: every kind that carries fruit, three times.
    add_row({x, kFirstY, kSpacing, 200, 0.0, PlantPreset::numbered, {3, 4, 5, 6, 7, 8, 9}},
            &options);
  }
  options.copies = 21;
  options.high_y_m = 101.5;
  return options;
}

WorldOptions seedlings_world() {
  WorldOptions options = crop("seedlings", PlantPreset::seedling, 10, 0.3);
  options.high_y_m = 4.5;
  options.wall_height_m = 3.0;
  options.ground_per_plant_m2 = 0.25;
  return options;
}

const std::vector<std::string>& world_names() {
  static const std::vector<std::string> kNames = {"scenario_1", "scenario_2", "dense_1", "dense_2",
                                                  "row_100m",   "seedlings",  "empty"};
  return kNames;
}

std::optional<WorldOptions> named_world(const std::string& name) {
  if (name == "scenario_1") return scenario_1_world();
  if (name == "scenario_2") return scenario_2_world();
  if (name == "dense_1") return dense_1_world();
  if (name == "dense_2") return dense_2_world();
  if (name == "row_100m") return row_100m_world();
  if (name == "seedlings") return seedlings_world();
  if (name == "empty") return WorldOptions{};
  return std::nullopt;
}

}  // namespace canopeer
