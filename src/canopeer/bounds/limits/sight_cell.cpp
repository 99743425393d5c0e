#include "canopeer/bounds/limits/sight_cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canopeer {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;

/// The most and the least that length·sin(angle) can be when the angle is off by `turn`.
double highest(double along, double length, double turn) {
  if (length <= 0.0) return 0.0;
  const double angle = std::asin(std::clamp(along / length, -1.0, 1.0));
  return length * std::sin(std::min(kQuarter, angle + turn));
}
double lowest(double along, double length, double turn) { return -highest(-along, length, turn); }

}  // namespace

Frustum::Frustum(const CameraIntrinsics& camera, double max_depth_m)
    : min_depth_m_(camera.min_range_m), max_depth_m_(max_depth_m) {
  const double left = -camera.cx / camera.fx;
  const double right = (camera.width - camera.cx) / camera.fx;
  const double top = -camera.cy / camera.fy;
  const double bottom = (camera.height - camera.cy) / camera.fy;
  sides_[0] = Vec3(1.0, 0.0, -left).normalized();
  sides_[1] = Vec3(-1.0, 0.0, right).normalized();
  sides_[2] = Vec3(0.0, 1.0, -top).normalized();
  sides_[3] = Vec3(0.0, -1.0, bottom).normalized();
  for (const double x : {left, right}) {
    for (const double y : {top, bottom}) {
      farthest_m_ = std::max(farthest_m_, max_depth_m * Vec3(x, y, 1.0).norm());
    }
  }
}

bool Frustum::may_hold(const FruitBall& ball, const CameraCell& cell) const {
  const Vec3 p = cell.T.inverse() * ball.centre;
  const double length = p.norm();
  const double slack = cell.shift_m + ball.radius_m;
  if (length > farthest_m_ + slack) return false;
  if (highest(p.z(), length, cell.turn_rad) + slack < min_depth_m_) return false;
  if (lowest(p.z(), length, cell.turn_rad) - slack > max_depth_m_) return false;
  return std::all_of(std::begin(sides_), std::end(sides_), [&](const Vec3& side) {
    return highest(side.dot(p), length, cell.turn_rad) + slack >= 0.0;
  });
}

CameraCell camera_cell(const RobotModel& robot, const JointBox& box, Configuration* arms) {
  CameraCell cell;
  RobotModel::Jacobian jacobian(6, robot.dof());
  robot.camera_jacobian(box.centre, cell.T, jacobian);
  if (arms != nullptr) *arms = Configuration::Zero(robot.dof());
  for (int i = robot.dof(); i-- > 0;) {
    const bool turns = robot.arm_joint_type(i) == JointType::kRevolute;
    const double arm = turns ? jacobian.col(i).head<3>().norm() + cell.shift_m : 1.0;
    if (arms != nullptr) (*arms)[i] = arm;
    cell.shift_m += box.half[i] * arm;
    if (turns) cell.turn_rad += box.half[i];
  }
  return cell;
}

double camera_reach_m(const RobotModel& robot) {
  double way = 0.0;
  for (const RobotModel::Hop& hop : robot.arm_hops(robot.link_index(robot.setup().camera_frame))) {
    way += hop.offset.norm() + hop.slide;
  }
  return way;
}

}  // namespace canopeer
