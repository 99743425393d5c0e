#pragma once

#include "canopeer/robot/joint_path.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// How fast the trolley may travel with the arm at `q`, so that the image moves no faster than
/// `limit` says; m/s, infinite where travelling does not move the camera.
[[nodiscard]] double drive_speed(const RobotModel& robot, const Configuration& q,
                                 const ImageMotionLimit& limit);

}  // namespace canopeer
