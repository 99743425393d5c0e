#pragma once

#include <vector>

#include "canopeer/robot/configuration.h"
#include "canopeer/sensing/camera_twist.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// A frame, and how arm and camera moved then.
struct FilmedFrame {
  RgbdFrame frame;  ///< time_s: since the film began
  CameraTwist twist;
  Configuration q;  ///< rad
};

constexpr double kFilmHz = 15.0;

/// What a camera of 15 Hz with 5 ms of exposure sees at stop 1, side 1 of Scenario 1 (seed 1) while
/// the UR5e goes from view to view as a view planner sends it, as fast as it can: 640 × 480 pixels,
/// with true labels. Rendered at the first call.
const std::vector<FilmedFrame>& film();

}  // namespace canopeer
