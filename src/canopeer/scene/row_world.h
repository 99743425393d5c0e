#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// Where a plant of which kind stands.
struct PlantPlacement {
  int kind = 3;                  ///< 1 … 9, see plant_kind()
  Vec3 position = Vec3::Zero();  ///< of the stem base, world
  double yaw_rad = 0.0;          ///< about z
};

/// A glasshouse with plants in it.
struct WorldOptions {
  std::string name = "world";
  std::vector<PlantPlacement> plants;
  bool walls = true;
  bool floor = true;
  double wall_x_m = 3.85;  ///< walls at ± this
  double wall_height_m = 3.0;
  double half_length_m = 4.5;  ///< of floor and walls along y, about 0
  int distractors = 24;        ///< clips, dry leaves and labels that are reddish but no fruit
  bool pipes = true;           ///< terracotta heating pipes on the ground behind the rows
};

/// Scenario 1 of the paper: 12 plants in two rows at x = ±0.75 m, 47 ripe or turning fruits.
WorldOptions scenario_1_world();

/// Builds the world. The same options and seed give the same scene bit for bit. No fruit touches
/// another plant.
Scene make_world(const WorldOptions& options, std::uint64_t seed);

}  // namespace canopeer
