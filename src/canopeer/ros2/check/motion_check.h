#pragma once

#include "canopeer/ros2/check/check_bench.h"
#include "canopeer/ros2/check/findings.h"
#include "canopeer/sensing/hand_eye.h"

namespace canopeer::ros {

/// Moves the arm slowly about where it is, within a hand's breadth of the camera's place, takes
/// frames where it stands and while it moves, and says whether mounting and clock of the camera are
/// right. The arm ends where it began.
void check_by_moving(CheckBench& bench, Findings& findings);

/// The findings of an estimate: what is wrong, the residual of each pose, what to change.
/// `time_offset_s`: what settings add already. `from_tf`: poses did not come from joint states.
void tell_hand_eye(const HandEyeEstimate& estimate, double time_offset_s, bool from_tf,
                   Findings& findings);

}  // namespace canopeer::ros
