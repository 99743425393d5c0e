#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "canopeer/scene/plants/plant.h"
#include "canopeer/scene/row_world.h"

namespace canopeer {

/// A plant at its place.
struct PlacedPlant {
  std::shared_ptr<Plant> plant;  ///< copies share it
  Pose T_world_plant = Pose::Identity();
  Box bounds;             ///< world
  int model = -1;         ///< of a copy: which of the grown plants; −1: grown for this place
  double string_m = 0.0;  ///< height over the stem base of the wire its strings hang on; 0: none
};

/// Grows the plants of a world one after the other, so that none touches another's fruits. Plants
/// of the paper are grown anew until they stand clear. Leaves of dense plants that touch are left
/// out, as leaves give way. In a world with `copies` so many plants are grown; the others are
/// copies of them, turned at random.
std::vector<PlacedPlant> grow_rows(const WorldOptions& options, std::uint64_t seed);

}  // namespace canopeer
