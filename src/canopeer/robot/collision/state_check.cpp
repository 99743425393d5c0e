// CollisionChecker::state_free: the answer of measure(), found with less work because nobody asks
// for clearances. Neighbouring spheres are looked up in the map together, and the bounds of four
// arm links are held against an obstacle at a time.

#include <algorithm>
#include <cmath>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/robot/collision_checker.h"

namespace canopeer {
namespace {

/// Groups of spheres are no larger: the distance field's truncation would hide that they are free.
constexpr double kGroupRadiusM = 0.10;

constexpr int kLanes = 4;
using Lanes = FourDoubles;
using LaneMask = long long __attribute__((vector_size(32)));

[[gnu::always_inline]] inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

[[gnu::always_inline]] inline Lanes size_of(Lanes a) { return larger(a, -a); }

[[gnu::always_inline]] inline Lanes apply(const double* pose, const Vec3& p) {
  return load_lanes<FourDoubles>(pose) * p.x() + load_lanes<FourDoubles>(pose + 4) * p.y() +
         load_lanes<FourDoubles>(pose + 8) * p.z() + load_lanes<FourDoubles>(pose + 12);
}

/// Arm links whose bounds are placed at a time.
constexpr int kBlock = 24;

int steps_of_four(std::size_t count) {
  return static_cast<int>((count + kLanes - 1) / kLanes) * kLanes;
}

}  // namespace

void CollisionChecker::collect_groups() {
  groups_.clear();
  for (std::size_t a = 0; a < arm_links_.size(); ++a) {
    std::vector<Sphere> spheres;
    for (int i = arm_links_[a].first_sphere; i < arm_links_[a].last_sphere; ++i) {
      const Sphere next{centres_[i], radii_m_[i]};
      spheres.push_back(next);
      if (spheres.size() == 1 || bounding_sphere(spheres).radius_m > kGroupRadiusM) {
        spheres = {next};
        groups_.push_back({static_cast<int>(a), i, i, next});
      }
      groups_.back().last_sphere = i + 1;
      groups_.back().bound = bounding_sphere(spheres);
    }
  }
}

void CollisionChecker::collect_reaches() {
  apart2_m2_.clear();
  for (std::size_t first = 0; first < arm_links_.size(); first += kBlock) {
    const std::size_t count = std::min<std::size_t>(kBlock, arm_links_.size() - first);
    for (const Obstacle& obstacle : obstacles_) {
      const bool box = obstacle.body < 0 && obstacle.shape.kind == ShapeKind::kBox;
      const std::size_t row = apart2_m2_.size();
      apart2_m2_.resize(row + static_cast<std::size_t>(steps_of_four(count)), -1.0);
      for (const int link : obstacle.arm_links) {
        const auto a = static_cast<std::size_t>(link);
        if (a < first || a >= first + count) continue;
        const double apart = arm_links_[a].bound.radius_m + options_.self_padding_m +
                             (box ? 0.0 : obstacle.radius_m);
        apart2_m2_[row + a - first] = apart * apart;
      }
    }
  }
}

bool CollisionChecker::group_free(const Pose& T_world_body, const SphereGroup& group) const {
  for (int i = group.first_sphere; i < group.last_sphere; ++i) {
    const Vec3 centre = T_world_body * centres_[i];
    if (static_cast<double>(map_->distance(centre)) - radii_m_[i] >= options_.map_padding_m)
      continue;
    if (shape_clearance(T_world_body, centre, i, options_.map_padding_m,
                        options_.map_padding_m + kShapeMarginM) < options_.map_padding_m)
      return false;
  }
  return true;
}

bool CollisionChecker::pair_free(const Obstacle& obstacle, const ArmLink& arm_link,
                                 const Pose* T_world_body) const {
  const Pose T_shape_world =
      obstacle.body < 0 ? obstacle.T_shape_world
                        : (T_world_body[obstacle.body] * obstacle.shape.T_link_shape).inverse();
  const Pose& T_world_arm = T_world_body[arm_link.body];
  const Vec3 bound = T_shape_world * (T_world_arm * arm_link.bound.centre);
  if (signed_distance(obstacle.shape, bound) - arm_link.bound.radius_m >= options_.self_padding_m)
    return true;
  int apart = -1;  // the shape of the link last found to be
  for (int i = arm_link.first_sphere; i < arm_link.last_sphere; ++i) {
    const Vec3 centre = T_shape_world * (T_world_arm * centres_[i]);
    if (signed_distance(obstacle.shape, centre) - radii_m_[i] >= options_.self_padding_m) continue;
    const int shape = sphere_shapes_[i];
    if (shape == apart) continue;
    if (!has_mesh(obstacle, shape) ||
        mesh_gap(obstacle, shape, T_shape_world * T_world_arm) < options_.self_padding_m)
      return false;
    apart = shape;
  }
  return true;
}

/// Arm links `first` … against all obstacles; `apart2` moves on to the next block's row.
[[gnu::always_inline]] inline bool CollisionChecker::look_at_block(std::size_t first_link,
                                                                   std::size_t count,
                                                                   const Pose* T_world_body,
                                                                   const double*& apart2) const {
  const ArmLink* const links = arm_links_.data() + first_link;
  double x[kBlock] = {};
  double y[kBlock] = {};
  double z[kBlock] = {};
  for (std::size_t a = 0; a < count; ++a) {
    const Lanes centre = apply(T_world_body[links[a].body].matrix().data(), links[a].bound.centre);
    x[a] = centre[0];
    y[a] = centre[1];
    z[a] = centre[2];
  }
  const int lanes = steps_of_four(count);
  for (const Obstacle& obstacle : obstacles_) {
    Lanes c{obstacle.centre.x(), obstacle.centre.y(), obstacle.centre.z(), 0.0};
    if (obstacle.body >= 0) c = apply(T_world_body[obstacle.body].matrix().data(), obstacle.centre);
    const bool box = obstacle.body < 0 && obstacle.shape.kind == ShapeKind::kBox;
    const auto& T = obstacle.T_shape_world.matrix();
    for (int first = 0; first < lanes; first += kLanes, apart2 += kLanes) {
      const Lanes px = load_lanes<FourDoubles>(x + first);
      const Lanes py = load_lanes<FourDoubles>(y + first);
      const Lanes pz = load_lanes<FourDoubles>(z + first);
      Lanes dx = px - c[0];
      Lanes dy = py - c[1];
      Lanes dz = pz - c[2];
      if (box) {
        const Vec3 half = obstacle.shape.size_m / 2.0;
        const Lanes zero{};
        dx = larger(size_of(px * T(0, 0) + py * T(0, 1) + pz * T(0, 2) + T(0, 3)) - half.x(), zero);
        dy = larger(size_of(px * T(1, 0) + py * T(1, 1) + pz * T(1, 2) + T(1, 3)) - half.y(), zero);
        dz = larger(size_of(px * T(2, 0) + py * T(2, 1) + pz * T(2, 2) + T(2, 3)) - half.z(), zero);
      }
      const LaneMask near = dx * dx + dy * dy + dz * dz < load_lanes<FourDoubles>(apart2);
      if ((near[0] | near[1] | near[2] | near[3]) == 0) continue;
      for (int lane = 0; lane < kLanes; ++lane) {
        if (near[lane] != 0 && !pair_free(obstacle, links[first + lane], T_world_body))
          return false;
      }
    }
  }
  return true;
}

[[gnu::always_inline]] inline bool CollisionChecker::look_at_state(const Configuration& q) const {
  Pose T_world_body[RobotModel::kMaxBodies];
  robot_->body_poses(q, T_world_base_, T_world_body);

  if (map_ != nullptr) {
    // With a voxel's diagonal to spare no sphere inside can be found nearer than its padding.
    const double spare = options_.map_padding_m + std::sqrt(3.0) * map_->resolution_m();
    const Box& known = map_->world();
    for (const SphereGroup& group : groups_) {
      const Pose& T = T_world_body[arm_links_[group.arm_link].body];
      const Lanes lanes = apply(T.matrix().data(), group.bound.centre);
      const Vec3 centre(lanes[0], lanes[1], lanes[2]);
      // A centre beyond the field's box says nothing of spheres within it.
      const double inside =
          std::min((centre - known.min()).minCoeff(), (known.max() - centre).minCoeff());
      const double clearance = static_cast<double>(map_->distance(centre)) - group.bound.radius_m;
      if (inside >= group.bound.radius_m && clearance >= spare) continue;
      if (!group_free(T, group)) return false;
    }
  }

  const double* apart2 = apart2_m2_.data();
  for (std::size_t first = 0; first < arm_links_.size(); first += kBlock) {
    const std::size_t count = std::min<std::size_t>(kBlock, arm_links_.size() - first);
    if (!look_at_block(first, count, T_world_body, apart2)) return false;
  }
  return true;
}

CANOPEER_WIDE bool CollisionChecker::state_free_wide(const Configuration& q) const {
  return look_at_state(q);
}

bool CollisionChecker::state_free_narrow(const Configuration& q) const { return look_at_state(q); }

bool CollisionChecker::state_free(const Configuration& q) const {
  if (!robot_->within_limits(q)) return false;
  return has_wide_registers() ? state_free_wide(q) : state_free_narrow(q);
}

}  // namespace canopeer
