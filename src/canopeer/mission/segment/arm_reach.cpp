#include "canopeer/mission/segment/arm_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace canopeer {

double arm_reach_m(const RobotModel& robot) {
  double farthest = 0.0;
  std::vector<Pose> T_world_link;
  robot.link_poses(Configuration::Zero(robot.dof()), {}, T_world_link);
  double begin = 0.0;
  for (const int link : robot.moving_links()) {
    if (robot.arm_hops(link).size() > 1) continue;  // it hangs on another that moves
    begin = std::max(begin, (T_world_link[static_cast<std::size_t>(link)].translation() -
                             robot.T_world_base({}).translation())
                                .norm());
  }
  if (robot.arm_joint_type(0) == JointType::kPrismatic)
    begin += std::max(std::abs(robot.limits().lower[0]), std::abs(robot.limits().upper[0]));
  for (const int link : robot.moving_links()) {
    double way = begin;
    for (const RobotModel::Hop& hop : robot.arm_hops(link)) way += hop.offset.norm() + hop.slide;
    for (const CollisionShape& shape : robot.links()[link].collision) {
      farthest = std::max(
          farthest, way + shape.T_link_shape.translation().norm() + shape.half_extents().norm());
    }
  }
  return farthest;
}

}  // namespace canopeer
