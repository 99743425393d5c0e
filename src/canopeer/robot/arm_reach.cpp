#include "canopeer/robot/arm_reach.h"

#include <algorithm>

namespace canopeer {

double arm_reach_m(const RobotModel& robot) {
  double farthest = 0.0;
  for (const int link : robot.moving_links()) {
    double way = 0.0;
    for (const RobotModel::Hop& hop : robot.arm_hops(link)) way += hop.offset.norm() + hop.slide;
    for (const CollisionShape& shape : robot.links()[link].collision) {
      farthest = std::max(
          farthest, way + shape.T_link_shape.translation().norm() + shape.half_extents().norm());
    }
  }
  return farthest;
}

}  // namespace canopeer
