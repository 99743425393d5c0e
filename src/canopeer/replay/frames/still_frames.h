#pragma once

#include "canopeer/replay/frame.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sensing/camera_intrinsics.h"

// What does not change during a run.

namespace canopeer::frames {

[[nodiscard]] Frame robot_frame(const RobotModel& robot, const CameraIntrinsics& camera);
/// The true plants and fruits, copies of models too. Coordinates keep twelve bits: 0.4 mm at 3 m.
[[nodiscard]] Frame truth_frame(const Scene& scene);

}  // namespace canopeer::frames
