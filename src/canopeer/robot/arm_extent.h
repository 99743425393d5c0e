#pragma once

#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// A box around all that moves with the arm, arm base frame, axes of that: around the boxes of its
/// collision shapes. Empty: nothing of it has a shape.
[[nodiscard]] Box arm_extent(const RobotModel& robot, const Configuration& q);

/// Whether the trolley may drive along the row with the arm at `q`: across the row and in height
/// nothing of the arm is outside of the place where nothing but the robot is
/// (RobotSetup::known_free) or nearer to its border than `margin_m`. False where no such place is
/// known, or nothing of the arm has a shape.
[[nodiscard]] bool keeps_to_aisle(const RobotModel& robot, const Configuration& q,
                                  double margin_m = 0.0);

}  // namespace canopeer
