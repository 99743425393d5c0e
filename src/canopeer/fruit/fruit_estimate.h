#pragma once

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// One fruit as far as it is known: a superellipsoid with its pose.
/// Until shapes are fitted it is a sphere or ellipsoid: e1 = e2 = 1.
struct FruitEstimate {
  int id = 0;
  Vec3 centre = Vec3::Zero();       ///< world
  Vec3 semi_axes_m = Vec3::Zero();  ///< a, b, c
  double e1 = 1.0;
  double e2 = 1.0;
  Vec3 roll_pitch_yaw_rad = Vec3::Zero();  ///< R = Rz(yaw) Ry(pitch) Rx(roll), fruit frame to world
  double volume_cm3 = 0.0;
  int points = 0;           ///< distinct surface cells seen
  double confidence = 0.0;  ///< 0 … 1
};

}  // namespace canopeer
