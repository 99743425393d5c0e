#pragma once

#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/view_ik.h"

namespace canopeer {

/// What a mission knows of the robot. All outlive the mission.
struct RobotKit {
  const RobotModel& model;
  const ArmIk& ik;
  const ExactChecker& judge;  ///< slow and exact, with the structure around if that is known
};

}  // namespace canopeer
