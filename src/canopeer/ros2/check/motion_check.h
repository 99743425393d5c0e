#pragma once

#include "canopeer/ros2/check/check_bench.h"
#include "canopeer/ros2/check/findings.h"
#include "canopeer/sensing/hand_eye.h"

namespace canopeer::ros {

/// Moves the arm slowly about where it is, within a hand's breadth of the camera's place, takes
/// frames where it stands and while it moves, and says whether mounting and clock of the camera are
/// right. At most so many looks. The arm ends where it began.
void check_by_moving(CheckBench& bench, int looks, Findings& findings);

/// What was assumed of the camera.
struct AssumedCamera {
  Pose T_frame_camera = Pose::Identity();  ///< its mounting: camera_mounting of robot files
  double time_offset_s = 0.0;              ///< of the settings
  bool pose_from_tf = false;               ///< poses did not come from joint states
  std::size_t still = 0;  ///< so many frames, the first, are from where the arm stood
};

/// The findings of an estimate: what is wrong, the residual of each pose, what to change.
void tell_hand_eye(const HandEyeEstimate& estimate, const AssumedCamera& assumed,
                   Findings& findings);

}  // namespace canopeer::ros
