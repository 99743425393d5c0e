#include "canopeer/robot/arm_extent.h"

#include <vector>

namespace canopeer {

Box arm_extent(const RobotModel& robot, const Configuration& q) {
  const TrolleyState trolley;
  std::vector<Pose> T_world_link;
  robot.link_poses(q, trolley, T_world_link);
  const Pose T_base_world = robot.T_world_base(trolley).inverse();
  Box extent;
  for (const int link : robot.moving_links()) {
    const auto index = static_cast<std::size_t>(link);
    for (const CollisionShape& shape : robot.links()[index].collision) {
      const Pose T_base_shape = T_base_world * T_world_link[index] * shape.T_link_shape;
      extent.extend(transformed(Box(-shape.half_extents(), shape.half_extents()), T_base_shape));
    }
  }
  return extent;
}

bool keeps_to_aisle(const RobotModel& robot, const Configuration& q, double margin_m) {
  const Box& aisle = robot.setup().known_free;
  const Box arm = arm_extent(robot, q);
  if (aisle.isEmpty() || arm.isEmpty()) return false;
  const Pose from = robot.T_world_base({0.0, 0.0});
  const Pose to = robot.T_world_base({1.0, 0.0});
  const Vec3 travel_base = from.linear().transpose() * (to.translation() - from.translation());
  Eigen::Index along = 0;
  travel_base.cwiseAbs().maxCoeff(&along);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (axis == along) continue;
    if (arm.min()[axis] < aisle.min()[axis] + margin_m) return false;
    if (arm.max()[axis] > aisle.max()[axis] - margin_m) return false;
  }
  return true;
}

}  // namespace canopeer
