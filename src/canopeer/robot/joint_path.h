#pragma once

#include <vector>

#include "canopeer/robot/configuration.h"

namespace canopeer {

/// What an arm follows: straight lines in joint space between waypoints. Around the waypoints in
/// between there are arcs (BlendedPath), so that it need not stop there.
struct JointPath {
  std::vector<Configuration> waypoints{};  ///< rad (m); the first is where the arm is
  /// One for each waypoint: how far the path may pass it, Euclidean joint distance, rad (m). 0: the
  /// arm stops there, as it does at the ends. Empty: it stops at every waypoint.
  std::vector<double> deviations{};
};

}  // namespace canopeer
