#pragma once

#include <optional>
#include <vector>

#include "canopeer/robot/configuration.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// How fast the image of the camera at the arm may move, where frames are wanted on the way
/// (image_speed()).
struct ImageMotionLimit {
  CameraIntrinsics camera;
  double distance_m = 0.5;    ///< of what is looked at
  double speed_px_s = 200.0;  ///< blur that is allowed, by the exposure
};

/// What an arm follows: straight lines in joint space between waypoints. Around the waypoints in
/// between there are arcs (BlendedPath), so that it need not stop there.
struct JointPath {
  std::vector<Configuration> waypoints{};  ///< rad (m); the first is where the arm is
  /// One for each waypoint: how far the path may pass it, Euclidean joint distance, rad (m). 0: the
  /// arm stops there, as it does at the ends. Empty: it stops at every waypoint.
  std::vector<double> deviations{};
  /// It is followed no faster than that; nothing: as fast as its joints can.
  std::optional<ImageMotionLimit> sharp{};
};

}  // namespace canopeer
