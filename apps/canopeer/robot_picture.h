#pragma once

#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/sphere_cover.h"
#include "canopeer/scene/scene.h"

namespace canopeer::app {

/// The robot as a scene to look at: its visual (else collision) shapes, the workspace and the
/// sampling region of a side as frames of thin bars (green, yellow). With `spheres` the arm is
/// shown by what stands for it in collision checks.
[[nodiscard]] Scene robot_scene(const RobotModel& robot, const Configuration& q, int side,
                                bool spheres);

}  // namespace canopeer::app
