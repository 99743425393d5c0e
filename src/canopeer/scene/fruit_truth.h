#pragma once

#include <string>

#include "canopeer/geometry/pose.h"

namespace canopeer {

enum class Ripeness { green, turning, ripe };

/// Ground truth of one fruit. Counted fruits are those a run is scored on: ripe or turning ones.
struct FruitTruth {
  int id = 0;  ///< 0 … n − 1 in the scene
  Ripeness ripeness = Ripeness::ripe;
  bool counted = true;
  Vec3 centre = Vec3::Zero();  ///< centroid of the closed body, world
  double length_m = 0.0;       ///< along the fruit's own axis
  double diameter_m = 0.0;     ///< largest, across the axis
  double volume_cm3 = 0.0;     ///< of the closed body; of its convex hull in imported scenes
  double surface_cm2 = 0.0;
  int plant = 0;      ///< index of the plant in the scene
  std::string model;  ///< name of the model it belongs to, imported scenes only
};

}  // namespace canopeer
