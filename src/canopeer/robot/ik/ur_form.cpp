#include <algorithm>
#include <cmath>
#include <string>

#include "canopeer/base/hypotenuse.h"
#include "canopeer/geometry/angles.h"
#include "canopeer/robot/ik/axis_geometry.h"
#include "canopeer/robot/ik/closed_form_ik.h"

namespace canopeer {
namespace {

constexpr double kSingularSine5 = 1e-7;  // below this, θ6 is not determined by the pose

using Axis = RobotModel::AxisLine;

/// Denavit–Hartenberg form of the chain, frames 0 … 6: q_i = sign_i · (θ_i − offset_i).
class UrForm : public SixJointForm {
 public:
  static Expected<std::unique_ptr<SixJointForm>> make(const ArmGeometry& geometry);
  [[nodiscard]] IkKind kind() const override { return IkKind::kUrLike; }
  int branches(const Pose& T_base_camera, double last_reference,
               std::array<SixAngles, kMaxBranches>& out) const override;

 private:
  Pose T_0_base_ = Pose::Identity();
  Pose T_camera_6_ = Pose::Identity();
  double a2_ = 0.0;
  double a3_ = 0.0;
  double d4_ = 0.0;
  double d5_ = 0.0;
  double sign_[6] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  double offset_[6] = {};
};

// Lays Denavit–Hartenberg frames through the joint axes at q = 0, with alpha = 90°, 0, 0, 90°, −90°
// and every offset along the three parallel axes gathered in d4.
Expected<std::unique_ptr<SixJointForm>> UrForm::make(const ArmGeometry& geometry) {
  std::vector<Axis> axes = geometry.axes;
  auto form = std::make_unique<UrForm>();
  UrForm& ik = *form;
  for (const int i : {2, 3}) {
    if (!parallel(axes[1].direction, axes[i].direction))
      return fail("axes 2, 3 and 4 are not parallel");
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
    return fail("axes 1-2, 4-5 or 5-6 are not at right angles");

  double gap_12 = 0.0;
  double gap_45 = 0.0;
  double gap_56 = 0.0;
  const Vec3 o1 = meeting_point(axes[0], axes[1], gap_12);
  const Vec3 o4 = meeting_point(axes[3], axes[4], gap_45);
  const Vec3 o5 = meeting_point(axes[4], axes[5], gap_56);
  if (std::max({gap_12, gap_45, gap_56}) > kAxisTolerance)
    return fail("axes 1-2, 4-5 or 5-6 do not meet");

  // Where axes 3 and 4 pierce the plane through o1 at right angles to axis 2.
  const auto in_plane = [&](const Vec3& point) -> Vec3 { return point - z1 * z1.dot(point - o1); };
  const Vec3 o2 = in_plane(axes[2].point);
  const Vec3 o3 = in_plane(axes[3].point);
  ik.a2_ = (o2 - o1).norm();
  ik.a3_ = (o3 - o2).norm();
  if (ik.a2_ < 1e-3 || ik.a3_ < 1e-3) return fail("axes 2, 3 and 4 are not apart");
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
  ik.T_0_base_ = frame_of(o1, x1, z0).inverse();
  ik.T_camera_6_ = geometry.T_base_camera.inverse() * frame_of(o5, x5, z5);

  return form;
}

int UrForm::branches(const Pose& T_base_camera, double last_reference,
                     std::array<SixAngles, kMaxBranches>& out) const {
  const Pose T_0_6 = T_0_base_ * T_base_camera * T_camera_6_;
  const Vec3 p = T_0_6.translation();  // where axes 5 and 6 meet: no matter of θ6
  const double radius = hypotenuse(p.x(), p.y());
  if (radius <= std::abs(d4_)) return 0;

  int count = 0;
  double theta[6];
  const double shoulder = std::asin(d4_ / radius);
  for (const double theta_1 : {shoulder, kPi - shoulder}) {  // p · z1 = d4
    theta[0] = std::atan2(p.y(), p.x()) + theta_1;
    const double c1 = std::cos(theta[0]);
    const double s1 = std::sin(theta[0]);
    const Vec3 z1(s1, -c1, 0.0);
    const Vec3 z1_in_6 = T_0_6.linear().transpose() * z1;  // (s5 c6, −s5 s6, c5)
    const double sine_5 = hypotenuse(z1_in_6.x(), z1_in_6.y());
    const bool singular = sine_5 < kSingularSine5;
    const double bent_wrist = std::atan2(sine_5, z1_in_6.z());
    for (const double side : {1.0, -1.0}) {
      theta[4] = side * bent_wrist;
      theta[5] = singular ? sign_[5] * last_reference + offset_[5]
                          : std::atan2(-side * z1_in_6.y(), side * z1_in_6.x());

      // x4 = T_0_6 · (T_4_5 · T_5_6)⁻¹ applied to e_x; z4 likewise: what is left is a planar arm.
      const double c5 = z1_in_6.z();
      const double s5 = side * sine_5;
      const double c6 = singular ? std::cos(theta[5]) : side * z1_in_6.x() / sine_5;
      const double s6 = singular ? std::sin(theta[5]) : -side * z1_in_6.y() / sine_5;
      const Vec3 x4 = T_0_6.linear() * Vec3(c5 * c6, -c5 * s6, -s5);
      const Vec3 z4 = T_0_6.linear() * Vec3(-s6, -c6, 0.0);
      const Vec3 o4 = p - d5_ * z4;
      const double theta_234 = std::atan2(x4.z(), c1 * x4.x() + s1 * x4.y());
      const double x = c1 * o4.x() + s1 * o4.y();
      const double y = o4.z();

      const double cosine_3 = (x * x + y * y - a2_ * a2_ - a3_ * a3_) / (2.0 * a2_ * a3_);
      if (std::abs(cosine_3) > 1.0) continue;  // out of reach
      const double bent = std::acos(cosine_3);
      const double ahead = std::atan2(y, x);
      const double aside =
          std::atan2(a3_ * std::sqrt(1.0 - cosine_3 * cosine_3), a2_ + a3_ * cosine_3);
      for (const double bend : {1.0, -1.0}) {
        theta[2] = bend * bent;
        theta[1] = ahead - bend * aside;
        theta[3] = theta_234 - theta[1] - theta[2];
        SixAngles& q = out[static_cast<std::size_t>(count++)];
        for (int i = 0; i < 6; ++i)
          q[static_cast<std::size_t>(i)] = sign_[i] * (theta[i] - offset_[i]);
      }
    }
  }
  return count;
}

}  // namespace

Expected<std::unique_ptr<SixJointForm>> make_ur_form(const ArmGeometry& geometry) {
  return UrForm::make(geometry);
}

}  // namespace canopeer
