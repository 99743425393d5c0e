#include "canopeer/robot/view_ik.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGeometryTolerance = 1e-7;  // metres or unit vectors: axes of the description
constexpr double kSingularWristSine = 1e-7;  // below this, θ6 is not determined by the pose
constexpr double kSelfTestPositionM = 1e-6;
constexpr double kSelfTestRotation = 1e-6;

using Axis = RobotModel::AxisLine;

bool parallel(const Vec3& a, const Vec3& b) { return a.cross(b).norm() < kGeometryTolerance; }
bool perpendicular(const Vec3& a, const Vec3& b) { return std::abs(a.dot(b)) < kGeometryTolerance; }

/// Point where two axes at right angles meet; `gap` receives how far they miss each other.
Vec3 meeting_point(const Axis& a, const Axis& b, double& gap) {
  const Vec3 between = b.point - a.point;
  gap = std::abs(between.dot(a.direction.cross(b.direction)));
  return a.point + a.direction * between.dot(a.direction);
}

/// Angle from u to v about `axis`, all unit vectors, u and v perpendicular to it.
double angle_about(const Vec3& axis, const Vec3& u, const Vec3& v) {
  return std::atan2(axis.dot(u.cross(v)), u.dot(v));
}

Pose frame(const Vec3& origin, const Vec3& x, const Vec3& z) {
  Pose T = Pose::Identity();
  T.linear() << x, z.cross(x), z;
  T.translation() = origin;
  return T;
}

/// The 2π-equivalent of `angle` nearest to `reference` within [lower, upper]; false: none.
bool bring_near(double& angle, double reference, double lower, double upper) {
  angle += 2.0 * kPi * std::round((reference - angle) / (2.0 * kPi));
  if (angle > upper) angle -= 2.0 * kPi * std::ceil((angle - upper) / (2.0 * kPi));
  if (angle < lower) angle += 2.0 * kPi * std::ceil((lower - angle) / (2.0 * kPi));
  return angle >= lower && angle <= upper;
}

bool same_configuration(const Configuration& a, const Configuration& b) {
  return (a - b).lpNorm<Eigen::Infinity>() < 1e-9;
}

void sort_by_distance(const Configuration& reference, std::vector<Configuration>& configurations) {
  std::vector<std::pair<double, Configuration>> keyed;
  keyed.reserve(configurations.size());
  for (auto& q : configurations) {
    const double distance = joint_distance(reference, q);
    keyed.emplace_back(distance, std::move(q));
  }
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < keyed.size(); ++i) configurations[i] = std::move(keyed[i].second);
}

/// The closed form must return random configurations from their own camera poses.
Expected<void> self_test(const ArmIk& ik, const RobotModel& robot) {
  Rng rng(1, "arm-ik-self-test");
  std::vector<Configuration> found;
  for (int trial = 0; trial < 50; ++trial) {
    Configuration q(robot.dof());
    for (int i = 0; i < q.size(); ++i)
      q[i] = rng.uniform(robot.limits().lower[i], robot.limits().upper[i]);
    const Pose T = robot.T_base_camera(q);
    found.clear();
    ik.solve(T, q, found);
    bool itself = false;
    for (const Configuration& candidate : found) {
      const Pose reached = robot.T_base_camera(candidate);
      if ((reached.translation() - T.translation()).norm() > kSelfTestPositionM ||
          (reached.linear() - T.linear()).norm() > kSelfTestRotation)
        return fail("inverse kinematics: the closed form does not fit this arm");
      itself = itself || (candidate - q).lpNorm<Eigen::Infinity>() < 1e-5;
    }
    if (!itself) return fail("inverse kinematics: the closed form misses solutions of this arm");
  }
  return {};
}

}  // namespace

// Lays Denavit–Hartenberg frames through the joint axes at q = 0, with alpha = 90°, 0, 0, 90°, −90°
// and every offset along the three parallel axes gathered in d4.
Expected<ArmIk> ArmIk::make(const RobotModel& robot) {
  const std::string refusal = "this arm is not built like a UR (";
  const std::string advice = "), and numeric inverse kinematics is not there yet";
  if (robot.dof() != 6) return fail(refusal + "it has no six joints" + advice);
  const Configuration zero = Configuration::Zero(6);
  std::vector<Axis> axes = robot.arm_axes(zero);

  ArmIk ik;
  ik.lower_ = robot.limits().lower;
  ik.upper_ = robot.limits().upper;
  for (double& sign : ik.sign_) sign = 1.0;
  for (const int i : {2, 3}) {
    if (!parallel(axes[1].direction, axes[i].direction))
      return fail(refusal + "axes 2, 3 and 4 are not parallel" + advice);
    if (axes[i].direction.dot(axes[1].direction) < 0.0) {
      ik.sign_[i] = -1.0;
      axes[i].direction = -axes[i].direction;
    }
  }
  const Vec3 z0 = axes[0].direction;
  const Vec3 z1 = axes[1].direction;
  const Vec3 z4 = axes[4].direction;
  const Vec3 z5 = axes[5].direction;
  if (!perpendicular(z0, z1) || !perpendicular(z1, z4) || !perpendicular(z4, z5))
    return fail(refusal + "axes 1-2, 4-5 or 5-6 are not at right angles" + advice);

  double gap_12 = 0.0;
  double gap_45 = 0.0;
  double gap_56 = 0.0;
  const Vec3 o1 = meeting_point(axes[0], axes[1], gap_12);
  const Vec3 o4 = meeting_point(axes[3], axes[4], gap_45);
  const Vec3 o5 = meeting_point(axes[4], axes[5], gap_56);
  if (std::max({gap_12, gap_45, gap_56}) > kGeometryTolerance)
    return fail(refusal + "axes 1-2, 4-5 or 5-6 do not meet" + advice);

  // Where axes 3 and 4 pierce the plane through o1 at right angles to axis 2.
  const auto in_plane = [&](const Vec3& point) -> Vec3 { return point - z1 * z1.dot(point - o1); };
  const Vec3 o2 = in_plane(axes[2].point);
  const Vec3 o3 = in_plane(axes[3].point);
  ik.a2_ = (o2 - o1).norm();
  ik.a3_ = (o3 - o2).norm();
  if (ik.a2_ < 1e-3 || ik.a3_ < 1e-3)
    return fail(refusal + "axes 2, 3 and 4 are not apart" + advice);
  ik.d4_ = z1.dot(o4 - o3);
  ik.d5_ = z4.dot(o5 - o4);

  const Vec3 x1 = z0.cross(z1);
  const Vec3 x2 = (o2 - o1) / ik.a2_;
  const Vec3 x3 = (o3 - o2) / ik.a3_;
  const Vec3 x4 = z1.cross(z4);
  const Vec3 x5 = z5.cross(z4);
  ik.offset_[0] = 0.0;  // frame 0 is laid so that x0 = x1 at q = 0
  ik.offset_[1] = angle_about(z1, x1, x2);
  ik.offset_[2] = angle_about(z1, x2, x3);
  ik.offset_[3] = angle_about(z1, x3, x4);
  ik.offset_[4] = angle_about(z4, x4, x5);
  ik.offset_[5] = 0.0;  // frame 6 is laid so that x6 = x5 at q = 0
  ik.T_0_base_ = frame(o1, x1, z0).inverse();
  ik.T_camera_6_ = robot.T_base_camera(zero).inverse() * frame(o5, x5, z5);

  if (auto tested = self_test(ik, robot); !tested) return fail(tested.error().message);
  return ik;
}

void ArmIk::solve(const Pose& T_base_camera, const Configuration& reference,
                  std::vector<Configuration>& out) const {
  CANOPEER_CHECK(reference.size() == 6, "reference of another arm");
  const Pose T_0_6 = T_0_base_ * T_base_camera * T_camera_6_;
  const Vec3 p = T_0_6.translation();  // where axes 5 and 6 meet: no matter of θ6
  const double radius = std::hypot(p.x(), p.y());
  if (radius <= std::abs(d4_)) return;
  const std::size_t first = out.size();

  const auto keep = [&](const double(&theta)[6]) {
    Configuration q(6);
    for (int i = 0; i < 6; ++i) {
      q[i] = sign_[i] * (theta[i] - offset_[i]);
      if (!bring_near(q[i], reference[i], lower_[i], upper_[i])) return;
    }
    for (std::size_t i = first; i < out.size(); ++i) {
      if (same_configuration(out[i], q)) return;
    }
    out.push_back(std::move(q));
  };

  double theta[6];
  const double shoulder = std::asin(d4_ / radius);
  for (const double theta_1 : {shoulder, kPi - shoulder}) {  // p · z1 = d4
    theta[0] = std::atan2(p.y(), p.x()) + theta_1;
    const double c1 = std::cos(theta[0]);
    const double s1 = std::sin(theta[0]);
    const Vec3 z1(s1, -c1, 0.0);
    const Vec3 z1_in_6 = T_0_6.linear().transpose() * z1;  // (s5 c6, −s5 s6, c5)
    const double sine_5 = std::hypot(z1_in_6.x(), z1_in_6.y());
    const bool singular = sine_5 < kSingularWristSine;
    for (const double side : {1.0, -1.0}) {
      theta[4] = std::atan2(side * sine_5, z1_in_6.z());
      theta[5] = singular ? sign_[5] * reference[5] + offset_[5]
                          : std::atan2(-side * z1_in_6.y(), side * z1_in_6.x());

      // x4 = T_0_6 · (T_4_5 · T_5_6)⁻¹ applied to e_x; z4 likewise: what is left is a planar arm.
      const double c5 = std::cos(theta[4]);
      const double s5 = std::sin(theta[4]);
      const double c6 = std::cos(theta[5]);
      const double s6 = std::sin(theta[5]);
      const Vec3 x4 = T_0_6.linear() * Vec3(c5 * c6, -c5 * s6, -s5);
      const Vec3 z4 = T_0_6.linear() * Vec3(-s6, -c6, 0.0);
      const Vec3 o4 = p - d5_ * z4;
      const double theta_234 = std::atan2(x4.z(), c1 * x4.x() + s1 * x4.y());
      const double x = c1 * o4.x() + s1 * o4.y();
      const double y = o4.z();

      const double cosine_3 = (x * x + y * y - a2_ * a2_ - a3_ * a3_) / (2.0 * a2_ * a3_);
      if (std::abs(cosine_3) > 1.0) continue;  // out of reach
      for (const double bend : {1.0, -1.0}) {
        theta[2] = bend * std::acos(cosine_3);
        theta[1] = std::atan2(y, x) - std::atan2(a3_ * std::sin(theta[2]), a2_ + a3_ * cosine_3);
        theta[3] = theta_234 - theta[1] - theta[2];
        keep(theta);
      }
    }
  }
}

void ArmIk::solve_view(const Vec3& position, const Vec3& target, const Configuration& reference,
                       std::vector<Configuration>& out, const ViewIkOptions& options) const {
  CANOPEER_CHECK(options.rolls > 0, "at least one roll");
  out.clear();
  for (int k = 0; k < options.rolls; ++k)
    solve(look_at(position, target, 2.0 * kPi * k / options.rolls), reference, out);
  sort_by_distance(reference, out);
}

}  // namespace canopeer
