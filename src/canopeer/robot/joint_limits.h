#pragma once

#include "canopeer/robot/configuration.h"

namespace canopeer {

/// Kinematic limits of the arm joints, one entry a joint; m instead of rad where it is prismatic.
struct JointLimits {
  Configuration lower;         ///< rad; −∞ where the joint turns without end
  Configuration upper;         ///< rad; ∞ likewise
  Configuration velocity;      ///< rad/s
  Configuration acceleration;  ///< rad/s²
};

/// A position no farther beyond a limit than this is at the limit: angles written with seven
/// digits, encoders, rounding. rad (m)
inline constexpr double kLimitTolerance = 1e-6;

/// Limits of size beyond this are none, rad: the reach of sin_cos(), with room.
inline constexpr double kLargestPosition = 1e4;

}  // namespace canopeer
