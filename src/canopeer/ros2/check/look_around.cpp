#include "canopeer/ros2/check/look_around.h"

#include <Eigen/Cholesky>
#include <optional>

namespace canopeer::ros {
namespace {

using Twist6 = Eigen::Matrix<double, 6, 1>;

/// Where the camera should be, from where it is: first its own translation, then a rotation.
struct Look {
  Vec3 step_m, turn_rad;
};

Twist6 way_to(const Pose& T_base_now, const Pose& T_base_goal) {
  Twist6 way;
  way.head<3>() = T_base_goal.translation() - T_base_now.translation();
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(T_base_goal.linear() * T_base_now.linear().transpose()));
  way.tail<3>() = turn.axis() * turn.angle();
  return way;
}

/// Damped least-squares steps towards a look; arms that cannot do all of it do what they can.
Configuration reach_for(const RobotModel& robot, const Configuration& from, const Look& look) {
  constexpr int kSteps = 30;
  constexpr double kDamping = 0.01;
  Pose move = Pose::Identity();
  move.translation() = look.step_m;
  if (look.turn_rad.norm() > 0.0) {
    move.linear() =
        Eigen::AngleAxisd(look.turn_rad.norm(), look.turn_rad.normalized()).toRotationMatrix();
  }
  const Pose T_base_goal = robot.T_base_camera(from) * move;
  Configuration q = from;
  for (int i = 0; i < kSteps; ++i) {
    Pose T_base_now;
    RobotModel::Jacobian jacobian(6, robot.dof());
    robot.camera_jacobian(q, T_base_now, jacobian);
    const Eigen::Matrix<double, 6, 6> square =
        jacobian * jacobian.transpose() + kDamping * Eigen::Matrix<double, 6, 6>::Identity();
    const Twist6 pull = square.ldlt().solve(way_to(T_base_now, T_base_goal));
    q += jacobian.transpose() * pull;
    q = q.cwiseMax(robot.limits().lower).cwiseMin(robot.limits().upper);
  }
  return q;
}

}  // namespace

std::vector<Configuration> looks_around(const RobotModel& robot, const CollisionChecker& checker,
                                        const Configuration& q, const LookAroundOptions& o) {
  const double t = o.turn_rad, r = o.roll_rad, s = o.step_m;
  // Turning about x shows what lies higher, so that the camera steps down, and so on.
  const std::vector<Look> looks = {
      {{0, s, 0}, {t, 0, 0}},   {{0, -s, 0}, {-t, 0, 0}},    {{-s, 0, 0}, {0, t, 0}},
      {{s, 0, 0}, {0, -t, 0}},  {{0, 0, 0}, {0, 0, r}},      {{0, 0, 0}, {0, 0, -r}},
      {{s, s, 0}, {t, -t, r}},  {{-s, -s, 0}, {-t, t, r}},   {{s, -s, 0}, {-t, -t, -r}},
      {{-s, s, 0}, {t, t, -r}}, {{0, 0, -s}, {0, 0, r / 2}}, {{s, 0, 0}, {0, 0, 0}}};
  std::vector<Configuration> found;
  for (const Look& look : looks) {
    constexpr int kHalvings = 3;
    for (int i = 0; i <= kHalvings; ++i) {
      const double share = 1.0 / (1 << i);
      const Configuration to = reach_for(robot, q, {share * look.step_m, share * look.turn_rad});
      if ((to - q).cwiseAbs().maxCoeff() > o.max_joint || !checker.edge_free(q, to)) continue;
      found.push_back(to);
      break;
    }
  }
  return found;
}

}  // namespace canopeer::ros
