#include "canopeer/sensing/alignment/frame_disagreement.h"

#include <cmath>
#include <optional>

namespace canopeer {
namespace {

constexpr float kSameNormal = 0.7F;     // cosine
constexpr double kNoise_m = 0.001;      // of distances, at any range
constexpr double kNoise_per_m = 0.003;  // and this times the square of the range: stereo

/// Frame b's camera from frame a's, both where they are assumed to be.
Pose between(const SoughtPose& at_a, const SoughtPose& at_b, const Pose& T_said_true) {
  return (at_b.T_world_said * T_said_true).inverse(Eigen::Isometry) * at_a.T_world_said *
         T_said_true;
}

/// A patch of a and the one of b that it lies on.
struct Meeting {
  Eigen::Vector3f moved;      // a's point in b's camera
  const SurfacePatch* patch;  // b's
  float distance;             // along b's normal
};

std::optional<Meeting> meet(const SurfacePatch& from, const SurfacePatches& b,
                            const Eigen::Isometry3f& T_b_a, float gate, bool* sought) {
  const Eigen::Vector3f moved = T_b_a * from.point;
  const SurfacePatch* const patch = b.seen_at(moved);
  *sought = patch != nullptr;
  if (patch == nullptr) return std::nullopt;
  const Eigen::Vector3f way = moved - patch->point;
  const float distance = patch->normal.dot(way);
  constexpr float kAlong = 2.0F;  // patches lie some pixels apart
  if (std::abs(distance) > gate || way.squaredNorm() > kAlong * kAlong * gate * gate ||
      patch->normal.dot(T_b_a.linear() * from.normal) < kSameNormal) {
    return std::nullopt;
  }
  return Meeting{moved, patch, distance};
}

/// The said camera's motion as one of the camera where it is assumed to be.
struct Twist {
  Vec3 velocity, turning;
};
Twist moved_twist(const SoughtPose& at, const Pose& T_said_true) {
  const Eigen::Matrix3d R = T_said_true.linear().transpose();
  const Vec3 at_place = at.velocity + at.turning.cross(Vec3(T_said_true.translation()));
  return {R * at_place, R * at.turning};
}

}  // namespace

HandEyeSums disagreement(const SurfacePatches& a, const SoughtPose& at_a, const SurfacePatches& b,
                         const SoughtPose& at_b, const Pose& T_said_true, double gate_m,
                         int stride) {
  const Pose T_b_a = between(at_a, at_b, T_said_true);
  const Eigen::Isometry3f T_b_a_float = T_b_a.cast<float>();
  const Eigen::Matrix3d R = T_b_a.linear();
  const Twist twist_a = moved_twist(at_a, T_said_true), twist_b = moved_twist(at_b, T_said_true);
  HandEyeSums sums;
  for (std::size_t i = 0; i < a.all().size(); i += static_cast<std::size_t>(stride)) {
    const SurfacePatch& from = a.all()[i];
    bool sought = false;
    const auto met = meet(from, b, T_b_a_float, static_cast<float>(gate_m), &sought);
    sums.sought += sought;
    if (!met) {
      sums.cost += sought ? 1.0 : 0.0;
      continue;
    }
    const Vec3 p = from.point.cast<double>(), y = met->moved.cast<double>();
    const Vec3 n = met->patch->normal.cast<double>();
    const double r = static_cast<double>(met->distance);
    const double noise = kNoise_m + kNoise_per_m * y.z() * y.z();
    // Tukey's biweight: nothing at the gate, no jump there.
    const double share = r / gate_m, rest = 1.0 - share * share;
    const double weight = rest * rest / (noise * noise);
    // A point of a moves with the camera at a, b's surface against the one at b.
    const Vec3 n_in_a = R.transpose() * n;
    HandEyeVector row;
    row.head<3>() = n_in_a - n;
    row.segment<3>(3) = p.cross(n_in_a) - y.cross(n);
    row[6] = n_in_a.dot(twist_a.turning.cross(p) + twist_a.velocity) -
             n.dot(twist_b.turning.cross(y) + twist_b.velocity);
    const HandEyeMatrix square = row * row.transpose();
    sums.matrix += weight * square;
    sums.curvature += rest * (1.0 - 5.0 * share * share) / (noise * noise) * square;
    sums.gradient += weight * r * row;
    sums.cost += 1.0 - rest * rest * rest;
    ++sums.points;
  }
  return sums;
}

void add_distances(const SurfacePatches& a, const SoughtPose& at_a, const SurfacePatches& b,
                   const SoughtPose& at_b, const Pose& T_said_true, double gate_m, int stride,
                   std::vector<float>* distances) {
  const Eigen::Isometry3f T_b_a = between(at_a, at_b, T_said_true).cast<float>();
  for (std::size_t i = 0; i < a.all().size(); i += static_cast<std::size_t>(stride)) {
    const SurfacePatch& from = a.all()[i];
    bool sought = false;
    const auto met = meet(from, b, T_b_a, static_cast<float>(gate_m), &sought);
    if (met) distances->push_back(std::abs(met->distance));
  }
}

}  // namespace canopeer
