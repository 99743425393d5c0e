#pragma once

#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// No point of the arm is ever farther than this from the origin of its base link, m: the lengths
/// along the chain added up.
[[nodiscard]] double arm_reach_m(const RobotModel& robot);

}  // namespace canopeer
