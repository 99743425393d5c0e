#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/scene/plants/plant_kind.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// Where a plant of which kind stands.
struct PlantPlacement {
  int kind = 3;                  ///< 1 … 9, see plant_kind(); of numbered plants
  Vec3 position = Vec3::Zero();  ///< of the stem base, world
  double yaw_rad = 0.0;          ///< about z
  PlantPreset preset = PlantPreset::numbered;
};

/// A glasshouse with plants in it.
struct WorldOptions {
  std::string name = "world";
  std::vector<PlantPlacement> plants;
  std::vector<Box> boards;  ///< that upper levels stand on, world
  bool walls = true;
  bool floor = true;
  bool strings = true;     ///< from the shoots of dense plants up to a wire
  bool gutters = false;    ///< under rows that stand above the floor
  double wall_x_m = 3.85;  ///< walls at ± this
  double wall_height_m = 3.0;
  double low_y_m = -4.5;  ///< ends of floor, walls, pipes and gutters along y
  double high_y_m = 4.5;
  int distractors = 24;  ///< clips, dry leaves and labels that are reddish but no fruit
  bool pipes = true;     ///< terracotta heating pipes on the ground
  std::vector<double> pipe_x_m = {-1.1, 1.1};
  /// For long rows: so many plants are grown (those first in `plants`), all others are copies of
  /// them, turned at random. 0: every plant is grown. Without distractors on the plants.
  int copies = 0;
  double ground_per_plant_m2 = 0.25;  ///< what the leaf area index is reckoned on
};

/// Builds the world. The same options and seed give the same scene bit for bit. No fruit touches
/// another plant.
Scene make_world(const WorldOptions& options, std::uint64_t seed);

}  // namespace canopeer
