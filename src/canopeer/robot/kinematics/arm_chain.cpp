#include "canopeer/robot/kinematics/arm_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/base/simd_vectors.h"
#include "canopeer/robot/kinematics/sin_cos.h"

namespace canopeer {
namespace {

/// A column of a pose's matrix.
using Column = FourDoubles;

/// Roundings of angles like 1.5707963267948966 in a description.
constexpr double kSnap = 1e-12;

/// Room for the angles in steps of four.
constexpr int kAngles = (kMaxArmJoints + ArmChain::kMaxFollowers + 3) / 4 * 4;

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

bool swaps_axes(const Eigen::Matrix3d& R) {
  return R.cwiseAbs().colwise().sum().isOnes(0.0) && R.cwiseAbs().rowwise().sum().isOnes(0.0) &&
         R.cwiseAbs().colwise().maxCoeff().isOnes(0.0);
}

}  // namespace

int ArmChain::add(int parent, const Pose& T_parent_joint, JointType type, const Vec3& axis,
                  int drive) {
  CANOPEER_CHECK(parent < size(), "parents come first");
  Segment segment;
  General general;
  segment.parent = parent;
  general.T_parent_joint = T_parent_joint;
  if (parent >= 0 && general_[static_cast<std::size_t>(parent)].fixed) {
    // What hangs on a fixed part hangs on what that hangs on: shorter chains.
    segment.parent = segments_[static_cast<std::size_t>(parent)].parent;
    general.T_parent_joint =
        general_[static_cast<std::size_t>(parent)].T_parent_joint * T_parent_joint;
  }
  general.T_parent_joint = snapped(general.T_parent_joint);
  general.axis = axis;
  general.fixed = drive < 0;
  general.turns = !general.fixed && type == JointType::kRevolute;
  segment.drive = std::max(0, drive);
  segment.offset_axis = offset_axis_of(general.T_parent_joint.translation());
  Vec3::Map(segment.offset) = general.T_parent_joint.translation();
  segment.slides = !general.fixed && type == JointType::kPrismatic;
  Vec3::Map(segment.along) = axis;

  const bool about_axis = axis.cwiseAbs().maxCoeff() == 1.0 && axis.cwiseAbs().sum() == 1.0;
  const Eigen::Matrix3d R = general.T_parent_joint.linear();
  if (!swaps_axes(R) || (general.turns && !about_axis)) {
    segment.kind = Kind::kAny;
  } else {
    Eigen::Index about = 2;
    if (general.turns) {
      axis.cwiseAbs().maxCoeff(&about);
      segment.kind = Kind::kSwapAndTurn;
    }
    for (int k = 0; k < 3; ++k) {
      const Eigen::Index own = (about + 1 + k) % 3;
      Eigen::Index from = 0;
      R.col(own).cwiseAbs().maxCoeff(&from);
      segment.axis[k] = static_cast<int>(4 * own);
      segment.from[k] = static_cast<int>(4 * from);
      segment.sign[k] = R(from, own);
    }
    if (general.turns) segment.turn_sign = axis[about];
  }
  segments_.push_back(segment);
  general_.push_back(general);
  return size() - 1;
}

int ArmChain::add_follower(int arm_joint, double multiplier, double offset) {
  CANOPEER_CHECK(followers_.size() < kMaxFollowers, "no room for another joint that follows");
  followers_.push_back({arm_joint, multiplier, offset});
  return dof_ + static_cast<int>(followers_.size()) - 1;
}

void ArmChain::turn_any(std::size_t segment, const Eigen::Matrix4d& parent, double sine,
                        double cosine, Eigen::Matrix4d& own) const {
  const General& general = general_[segment];
  Eigen::Matrix3d R = general.T_parent_joint.linear();
  if (general.turns) {  // Rodrigues
    const Vec3& a = general.axis;
    const Eigen::Matrix3d across{{0.0, -a.z(), a.y()}, {a.z(), 0.0, -a.x()}, {-a.y(), a.x(), 0.0}};
    R = R *
        (cosine * Eigen::Matrix3d::Identity() + sine * across + (1.0 - cosine) * a * a.transpose());
  }
  for (int k = 0; k < 3; ++k)
    own.col(k) = parent.col(0) * R(0, k) + parent.col(1) * R(1, k) + parent.col(2) * R(2, k);
}

[[gnu::always_inline]] inline void ArmChain::follow(const Motions& motions, const Pose& T_root,
                                                    Pose* T) const {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const Eigen::Matrix4d& parent_matrix =
        (segment.parent < 0 ? T_root : T[segment.parent]).matrix();
    const double* const parent = parent_matrix.data();
    double* const own = T[i].matrix().data();
    const double sine = motions.sines[segment.drive];
    const double cosine = motions.cosines[segment.drive];
    if (segment.kind == Kind::kSwapAndTurn) {
      // A swap of axes and a turn about one of them, in one: two columns mix, one is copied.
      const double s = segment.turn_sign * sine;
      const Column u = load_lanes<FourDoubles>(parent + segment.from[0]);
      const Column v = load_lanes<FourDoubles>(parent + segment.from[1]);
      store_lanes<FourDoubles>((cosine * segment.sign[0]) * u + (s * segment.sign[1]) * v,
                               own + segment.axis[0]);
      store_lanes<FourDoubles>((cosine * segment.sign[1]) * v - (s * segment.sign[0]) * u,
                               own + segment.axis[1]);
      store_lanes<FourDoubles>(segment.sign[2] * load_lanes<FourDoubles>(parent + segment.from[2]),
                               own + segment.axis[2]);
    } else if (segment.kind == Kind::kAny) {
      turn_any(i, parent_matrix, sine, cosine, T[i].matrix());
    } else {
      for (int k = 0; k < 3; ++k)
        store_lanes<FourDoubles>(
            segment.sign[k] * load_lanes<FourDoubles>(parent + segment.from[k]),
            own + segment.axis[k]);
    }
    Column origin = load_lanes<FourDoubles>(parent + 12);
    if (segment.offset_axis == 3) {
      origin += load_lanes<FourDoubles>(parent) * segment.offset[0] +
                load_lanes<FourDoubles>(parent + 4) * segment.offset[1] +
                load_lanes<FourDoubles>(parent + 8) * segment.offset[2];
    } else if (segment.offset_axis >= 0) {
      origin += load_lanes<FourDoubles>(parent + 4 * segment.offset_axis) *
                segment.offset[segment.offset_axis];
    }
    if (segment.slides) {
      origin += motions.q[segment.drive] * (load_lanes<FourDoubles>(own) * segment.along[0] +
                                            load_lanes<FourDoubles>(own + 4) * segment.along[1] +
                                            load_lanes<FourDoubles>(own + 8) * segment.along[2]);
    }
    store_lanes<FourDoubles>(origin, own + 12);
  }
}

CANOPEER_WIDE void ArmChain::follow_wide(const Motions& motions, const Pose& T_root,
                                         Pose* T) const {
  follow(motions, T_root, T);
}

void ArmChain::follow_narrow(const Motions& motions, const Pose& T_root, Pose* T) const {
  follow(motions, T_root, T);
}

void ArmChain::poses(const Configuration& q, const Pose& T_root, Pose* T) const {
  alignas(32) double angles[kAngles];
  alignas(32) double sines[kAngles];
  alignas(32) double cosines[kAngles];
  int drives = static_cast<int>(q.size());
  for (int i = 0; i < drives; ++i) angles[i] = q[i];
  for (const Follower& follower : followers_)
    angles[drives++] = follower.multiplier * q[follower.arm_joint] + follower.offset;
  for (int i = drives; i % 4 != 0; ++i) angles[i] = 0.0;
  sin_cos(angles, drives, sines, cosines);
  if (has_wide_registers()) {
    follow_wide({angles, sines, cosines}, T_root, T);
  } else {
    follow_narrow({angles, sines, cosines}, T_root, T);
  }
}

}  // namespace canopeer
