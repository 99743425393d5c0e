#pragma once

#include "canopeer/bounds/view_pool.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/view_ik.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/motion_judge.h"

namespace canopeer::test {

/// A few views of each segment: home, and configurations that touch nothing, each aimed at a
/// counted fruit. What they show is reckoned by rays from points on the fruits.
[[nodiscard]] ViewPool small_pool(const RobotModel& robot, const ArmIk& ik, const Scene& scene,
                                  const MotionJudge& judge, const MissionOptions& mission,
                                  const CameraIntrinsics& camera, int views);

}  // namespace canopeer::test
