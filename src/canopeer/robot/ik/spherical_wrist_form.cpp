#include <cmath>
#include <numbers>

#include "canopeer/base/hypotenuse.h"
#include "canopeer/robot/ik/axis_geometry.h"
#include "canopeer/robot/ik/closed_form_ik.h"

namespace canopeer {
namespace {

constexpr double kSingularWristSine = 1e-7;  // below this, the last angle is free

/// Shoulder frame S: on axis 1, z along it, y along axis 2. In its (z, x) plane a turn about axis 2
/// is a turn counter-clockwise.
class SphericalWristForm : public SixJointForm {
 public:
  static Expected<std::unique_ptr<SixJointForm>> make(const ArmGeometry& geometry);
  [[nodiscard]] IkKind kind() const override { return IkKind::kSphericalWrist; }
  int branches(const Pose& T_base_camera, double last_reference,
               std::array<SixAngles, kMaxBranches>& out) const override;

 private:
  int wrist(const Eigen::Matrix3d& R_wrist, const SixAngles& arm, double last_reference,
            std::array<SixAngles, kMaxBranches>& out, int count) const;

  Pose T_shoulder_base_ = Pose::Identity();
  Vec3 z1_, z2_, z4_, z5_, z6_;
  Vec3 wrist_in_camera_;
  Eigen::Matrix3d R_base_camera_;  // at q = 0
  double elbow_sign_ = 1.0;        // axis 3 along axis 2, or against it
  double lateral_ = 0.0;           // of the wrist's centre, along axis 2
  Eigen::Vector2d shoulder_;       // axis 2 in the plane
  double upper_ = 0.0;             // lengths of the planar arm
  double fore_ = 0.0;
  double upper_angle_ = 0.0;  // their directions at q = 0
  double fore_angle_ = 0.0;
  double wrist_angle_ = 0.0;  // from z4 to z6 about z5 at q = 0
};

Expected<std::unique_ptr<SixJointForm>> SphericalWristForm::make(const ArmGeometry& geometry) {
  const auto& axes = geometry.axes;
  auto form = std::make_unique<SphericalWristForm>();
  SphericalWristForm& ik = *form;
  const auto z = [&](int i) -> Vec3 { return axes[static_cast<std::size_t>(i - 1)].direction; };
  ik.z1_ = z(1);
  ik.z2_ = z(2);
  ik.z4_ = z(4);
  ik.z5_ = z(5);
  ik.z6_ = z(6);
  if (!perpendicular(z(1), z(2))) return fail("axes 1 and 2 are not at right angles");
  if (!parallel(z(2), z(3))) return fail("axes 2 and 3 are not parallel");
  if (!perpendicular(z(4), z(5)) || !perpendicular(z(5), z(6)))
    return fail("axes 4-5 or 5-6 are not at right angles");
  double gap_45 = 0.0;
  double gap_56 = 0.0;
  const Vec3 centre = meeting_point(axes[3], axes[4], gap_45);
  const Vec3 other = meeting_point(axes[4], axes[5], gap_56);
  if (gap_45 > kAxisTolerance || gap_56 > kAxisTolerance ||
      (centre - other).norm() > kAxisTolerance)
    return fail("axes 4, 5 and 6 do not meet in one point");

  const Vec3 foot = axes[0].point + z(1) * z(1).dot(axes[1].point - axes[0].point);
  ik.T_shoulder_base_ = frame_of(foot, z(2).cross(z(1)), z(1)).inverse();
  const auto planar = [&](const Vec3& p) -> Eigen::Vector2d {
    const Vec3 s = ik.T_shoulder_base_ * p;
    return {s.z(), s.x()};
  };
  ik.elbow_sign_ = z(3).dot(z(2)) > 0.0 ? 1.0 : -1.0;
  ik.lateral_ = (ik.T_shoulder_base_ * centre).y();
  ik.shoulder_ = planar(axes[1].point);
  const Eigen::Vector2d upper = planar(axes[2].point) - ik.shoulder_;
  const Eigen::Vector2d fore = planar(centre) - planar(axes[2].point);
  ik.upper_ = upper.norm();
  ik.fore_ = fore.norm();
  if (ik.upper_ < 1e-3 || ik.fore_ < 1e-3) return fail("axes 2, 3 and the wrist are not apart");
  ik.upper_angle_ = std::atan2(upper.y(), upper.x());
  ik.fore_angle_ = std::atan2(fore.y(), fore.x());
  ik.wrist_angle_ = angle_about(z(5), z(4), z(6));
  ik.R_base_camera_ = geometry.T_base_camera.linear();
  ik.wrist_in_camera_ = geometry.T_base_camera.inverse() * centre;
  return form;
}

int SphericalWristForm::branches(const Pose& T_base_camera, double last_reference,
                                 std::array<SixAngles, kMaxBranches>& out) const {
  const Vec3 p = T_shoulder_base_ * (T_base_camera * wrist_in_camera_);
  const double ahead2 = p.x() * p.x() + p.y() * p.y() - lateral_ * lateral_;
  if (ahead2 < 0.0) return 0;
  // All joints' turns together: R_T = R_123 · R_wrist · R(q = 0).
  const Eigen::Matrix3d R_turned = T_base_camera.linear() * R_base_camera_.transpose();
  int count = 0;
  for (const double side : {1.0, -1.0}) {
    const double ahead = side * std::sqrt(ahead2);
    SixAngles q{};
    q[0] = std::atan2(p.y(), p.x()) - std::atan2(lateral_, ahead);
    const Eigen::Vector2d reach = Eigen::Vector2d(p.z(), ahead) - shoulder_;
    const double cosine =
        (reach.squaredNorm() - upper_ * upper_ - fore_ * fore_) / (2.0 * upper_ * fore_);
    if (std::abs(cosine) > 1.0) continue;  // out of reach
    for (const double bend : {1.0, -1.0}) {
      const double elbow = bend * std::acos(cosine);
      const double lift = std::atan2(reach.y(), reach.x()) -
                          std::atan2(fore_ * std::sin(elbow), upper_ + fore_ * cosine);
      q[1] = lift - upper_angle_;
      q[2] = elbow_sign_ * (elbow - fore_angle_ + upper_angle_);
      const Eigen::Matrix3d R_arm =
          (Eigen::AngleAxisd(q[0], z1_) * Eigen::AngleAxisd(q[1] + elbow_sign_ * q[2], z2_))
              .toRotationMatrix();
      count = wrist(R_arm.transpose() * R_turned, q, last_reference, out, count);
    }
  }
  return count;
}

// R_wrist = exp(z4 q4) exp(z5 q5) exp(z6 q6): its image of z6 gives q4 and q5, its transpose's
// image of z4 gives q6.
int SphericalWristForm::wrist(const Eigen::Matrix3d& R_wrist, const SixAngles& arm,
                              double last_reference, std::array<SixAngles, kMaxBranches>& out,
                              int count) const {
  const Vec3 side_4 = z5_.cross(z4_);
  const Vec3 side_6 = z5_.cross(z6_);
  const Vec3 v = R_wrist * z6_;
  const Vec3 u = R_wrist.transpose() * z4_;
  const double sine = hypotenuse(v.dot(side_4), v.dot(z5_));
  const double bend = std::atan2(sine, v.dot(z4_));
  for (const double side : {1.0, -1.0}) {
    SixAngles q = arm;
    q[4] = side * bend - wrist_angle_;
    if (sine < kSingularWristSine) {
      q[5] = last_reference;
      const Vec3 w = R_wrist * (Eigen::AngleAxisd(-q[5], z6_) * z5_);
      q[3] = std::atan2(w.dot(z4_.cross(z5_)), w.dot(z5_));
    } else {
      q[3] = std::atan2(side * v.dot(z5_), side * v.dot(side_4));
      q[5] = std::atan2(side * u.dot(z5_), -side * u.dot(side_6));
    }
    out[static_cast<std::size_t>(count++)] = q;
  }
  return count;
}

}  // namespace

Expected<std::unique_ptr<SixJointForm>> make_spherical_wrist_form(const ArmGeometry& geometry) {
  return SphericalWristForm::make(geometry);
}

}  // namespace canopeer
