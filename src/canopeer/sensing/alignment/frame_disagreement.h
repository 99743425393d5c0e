#pragma once

#include <Eigen/Core>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/alignment/surface_patches.h"

namespace canopeer {

/// A camera pose that depends on what is sought: said pose, and how it moves with time.
struct SoughtPose {
  Pose T_world_said = Pose::Identity();
  Vec3 velocity = Vec3::Zero();  ///< of the said camera frame, in that frame, m/s
  Vec3 turning = Vec3::Zero();   ///< rad/s
};

/// What is sought: a translation and a rotation of the camera against its said place, and a time.
using HandEyeVector = Eigen::Matrix<double, 7, 1>;
using HandEyeMatrix = Eigen::Matrix<double, 7, 7>;

/// Sums of a least-squares step: matrix · step = −gradient.
struct HandEyeSums {
  HandEyeMatrix matrix = HandEyeMatrix::Zero();
  HandEyeVector gradient = HandEyeVector::Zero();
  /// How the gradient really changes: less than by `matrix`, where points that are none of the same
  /// surface lie within the gate; not at all, where all are such.
  HandEyeMatrix curvature = HandEyeMatrix::Zero();
  double cost = 0.0;  ///< robust, per point sought
  int points = 0;     ///< that met a surface
  int sought = 0;     ///< that lay in the other's view
};

/// Compares the surfaces that frame `a` shows with those of `b` where b sees them. `T_said_true`:
/// the camera's place that is assumed. Surfaces farther apart than `gate_m` are not the same one.
/// `stride`: every so many of a's patches.
[[nodiscard]] HandEyeSums disagreement(const SurfacePatches& a, const SoughtPose& at_a,
                                       const SurfacePatches& b, const SoughtPose& at_b,
                                       const Pose& T_said_true, double gate_m, int stride);

/// The distances themselves, m.
void add_distances(const SurfacePatches& a, const SoughtPose& at_a, const SurfacePatches& b,
                   const SoughtPose& at_b, const Pose& T_said_true, double gate_m, int stride,
                   std::vector<float>* distances);

}  // namespace canopeer
