#pragma once

#include <cmath>
#include <vector>

#include "canopeer/robot/view_ik.h"

namespace canopeer {

/// What ArmIk can be made of.
class IkSolver {
 public:
  virtual ~IkSolver() = default;
  [[nodiscard]] virtual IkKind kind() const = 0;
  [[nodiscard]] virtual int sampled_joints() const { return 0; }
  virtual void solve(const Pose& T_base_camera, const Configuration& reference,
                     std::vector<Configuration>& out) const = 0;
  /// Replaces `out`; in any order.
  virtual void solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                          std::vector<Configuration>& out, const ViewIkOptions& options) const = 0;
};

/// An arm as its joint axes at q = 0 tell it, base frame.
struct ArmGeometry {
  std::vector<RobotModel::AxisLine> axes;
  Pose T_base_camera = Pose::Identity();  ///< at q = 0
  Configuration lower;                    ///< −∞ where a joint turns without end
  Configuration upper;
};

/// The 2π-equivalent of `angle` nearest to `reference` within [lower, upper]; false: none.
inline bool bring_near(double& angle, double reference, double lower, double upper) {
  constexpr double kTurn = 6.283185307179586;
  constexpr double kPerTurn = 1.0 / kTurn;
  angle += kTurn * std::round((reference - angle) * kPerTurn);
  if (angle > upper) angle -= kTurn * std::ceil((angle - upper) * kPerTurn);
  if (angle < lower) angle += kTurn * std::ceil((lower - angle) * kPerTurn);
  return angle >= lower && angle <= upper;
}

/// The motion of a joint at `value`, as a map of the base frame onto itself.
inline Pose joint_motion(const RobotModel::AxisLine& axis, double value) {
  Pose T = Pose::Identity();
  if (axis.type == JointType::kPrismatic) {
    T.translation() = value * axis.direction;
  } else {
    T.linear() = Eigen::AngleAxisd(value, axis.direction).toRotationMatrix();
    T.translation() = axis.point - T.linear() * axis.point;
  }
  return T;
}

}  // namespace canopeer
