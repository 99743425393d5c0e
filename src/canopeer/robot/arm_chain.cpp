#include "canopeer/robot/arm_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/robot/sin_cos.h"

namespace canopeer {
namespace {

using Column = Eigen::Vector4d;

/// Roundings of angles like 1.5707963267948966 in a description.
constexpr double kSnap = 1e-12;

/// Room for the angles in steps of four.
constexpr int kAngles = (kMaxArmJoints + 3) / 4 * 4;

Pose snapped(Pose T) {
  for (int i = 0; i < 9; ++i) {
    double& entry = T.linear()(i / 3, i % 3);
    const double whole = std::round(entry);
    if (std::abs(entry - whole) < kSnap) entry = whole;
  }
  return T;
}

int offset_axis_of(const Vec3& offset) {
  const auto count = (offset.array() != 0.0).count();
  if (count == 0) return -1;
  if (count > 1) return 3;
  Eigen::Index axis = 0;
  offset.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

}  // namespace

int ArmChain::add(int parent, const Pose& T_parent_joint, JointType type, const Vec3& axis,
                  int arm_joint) {
  CANOPEER_CHECK(parent < size(), "parents come first");
  Segment segment;
  segment.parent = parent;
  segment.T_parent_joint = T_parent_joint;
  if (parent >= 0 && segments_[static_cast<std::size_t>(parent)].motion == Motion::kFixed) {
    // What hangs on a fixed part hangs on what that hangs on: shorter chains.
    const Segment& fixed = segments_[static_cast<std::size_t>(parent)];
    segment.parent = fixed.parent;
    segment.T_parent_joint = fixed.T_parent_joint * T_parent_joint;
  }
  segment.T_parent_joint = snapped(segment.T_parent_joint);
  segment.offset_axis = offset_axis_of(segment.T_parent_joint.translation());
  segment.arm_joint = arm_joint;
  segment.axis = axis;
  const Eigen::Matrix3d R = segment.T_parent_joint.linear();
  const bool swap = R.cwiseAbs().colwise().sum().isOnes(0.0) &&
                    R.cwiseAbs().rowwise().sum().isOnes(0.0) &&
                    R.cwiseAbs().colwise().maxCoeff().isOnes(0.0);
  segment.turn = swap ? Turn::kSwap : Turn::kGeneral;
  for (int k = 0; swap && k < 3; ++k) {
    R.col(k).cwiseAbs().maxCoeff(&segment.column[k]);
    segment.sign[k] = R(segment.column[k], k);
  }
  if (type == JointType::kPrismatic && arm_joint >= 0) segment.motion = Motion::kAlong;
  if (type == JointType::kRevolute && arm_joint >= 0) {
    segment.motion = Motion::kAboutAxis;
    for (const auto& [motion, along] : {std::pair(Motion::kAboutX, Vec3(Vec3::UnitX())),
                                        std::pair(Motion::kAboutY, Vec3(Vec3::UnitY())),
                                        std::pair(Motion::kAboutZ, Vec3(Vec3::UnitZ()))}) {
      if (axis != along && axis != -along) continue;
      segment.motion = motion;
      segment.axis_sign = axis.dot(along);
    }
  }
  segments_.push_back(segment);
  return size() - 1;
}

// A swap of axes and a turn about one of them, in one: two columns mix, one is copied.
void ArmChain::turn_swapped(const Segment& segment, const Eigen::Matrix4d& parent, double sine,
                            double cosine, Eigen::Matrix4d& own) {
  const int axis = static_cast<int>(segment.motion) - static_cast<int>(Motion::kAboutX);
  const int u = axis == 2 ? 0 : axis + 1;  // the turn leads from u to v
  const int v = axis == 0 ? 2 : axis - 1;
  const double s = segment.axis_sign * sine;
  const Column from_u = parent.col(segment.column[u]);
  const Column from_v = parent.col(segment.column[v]);
  own.col(u) = (cosine * segment.sign[u]) * from_u + (s * segment.sign[v]) * from_v;
  own.col(v) = (cosine * segment.sign[v]) * from_v - (s * segment.sign[u]) * from_u;
  own.col(axis) = segment.sign[axis] * parent.col(segment.column[axis]);
}

void ArmChain::turn_any(const Segment& segment, const Eigen::Matrix4d& parent, double sine,
                        double cosine, Eigen::Matrix4d& own) {
  Eigen::Matrix3d R = segment.T_parent_joint.linear();
  if (segment.motion != Motion::kFixed && segment.motion != Motion::kAlong) {  // Rodrigues
    const Vec3& a = segment.axis;
    const Eigen::Matrix3d across{{0.0, -a.z(), a.y()}, {a.z(), 0.0, -a.x()}, {-a.y(), a.x(), 0.0}};
    R = R *
        (cosine * Eigen::Matrix3d::Identity() + sine * across + (1.0 - cosine) * a * a.transpose());
  }
  for (int k = 0; k < 3; ++k)
    own.col(k) = parent.col(0) * R(0, k) + parent.col(1) * R(1, k) + parent.col(2) * R(2, k);
}

void ArmChain::poses(const Configuration& q, const Pose& T_root, Pose* T) const {
  alignas(32) double angles[kAngles] = {};
  alignas(32) double sines[kAngles];
  alignas(32) double cosines[kAngles];
  const int dof = static_cast<int>(q.size());
  for (int i = 0; i < dof; ++i) angles[i] = q[i];
  sin_cos(angles, dof, sines, cosines);

  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const Eigen::Matrix4d& parent = (segment.parent < 0 ? T_root : T[segment.parent]).matrix();
    Eigen::Matrix4d& own = T[i].matrix();
    const bool about_axis = segment.motion >= Motion::kAboutX && segment.motion <= Motion::kAboutZ;
    if (segment.turn == Turn::kSwap && about_axis) {
      turn_swapped(segment, parent, sines[segment.arm_joint], cosines[segment.arm_joint], own);
    } else if (segment.turn == Turn::kSwap && segment.motion != Motion::kAboutAxis) {
      for (int k = 0; k < 3; ++k) own.col(k) = segment.sign[k] * parent.col(segment.column[k]);
    } else {
      const int joint = std::max(0, segment.arm_joint);
      turn_any(segment, parent, sines[joint], cosines[joint], own);
    }
    Column origin = parent.col(3);
    const auto& offset = segment.T_parent_joint.matrix().col(3);
    if (segment.offset_axis == 3) {
      origin += parent.col(0) * offset[0] + parent.col(1) * offset[1] + parent.col(2) * offset[2];
    } else if (segment.offset_axis >= 0) {
      origin += parent.col(segment.offset_axis) * offset[segment.offset_axis];
    }
    if (segment.motion == Motion::kAlong)
      origin += angles[segment.arm_joint] *
                (own.col(0) * segment.axis.x() + own.col(1) * segment.axis.y() +
                 own.col(2) * segment.axis.z());
    own.col(3) = origin;
  }
}

}  // namespace canopeer
