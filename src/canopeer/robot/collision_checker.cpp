#include "canopeer/robot/collision_checker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/map/distance_field.h"

namespace canopeer {
namespace {

/// Clearances above this need not be known: intervals of an edge that long pass with it.
constexpr double kFarM = 0.15;

/// Bounds on self-clearances above this are good enough for an edge.
constexpr double kRefineBelowM = 0.04;

/// With no padding an interval counts as looked at when nothing moves farther than this in it.
constexpr double kSmallestMotionM = 0.001;

/// A straight motion in joint space, s from 0 to 1.
struct StraightCurve {
  const Configuration& a;
  const Configuration& b;

  [[nodiscard]] Configuration at(double s) const { return s == 1.0 ? b : a + s * (b - a); }
  [[nodiscard]] Configuration speed() const { return (b - a).cwiseAbs(); }
};

/// An arc in joint space, s from 0 to 1.
struct ArcCurve {
  const BlendedPath::Piece& piece;

  [[nodiscard]] Configuration at(double s) const {
    return BlendedPath::point(piece, piece.begin + s * piece.length);
  }
  /// q' = length (y cos − x sin), which no component exceeds in size by more than this.
  [[nodiscard]] Configuration speed() const {
    return piece.length * (piece.x.array().square() + piece.y.array().square()).sqrt().matrix();
  }
};

}  // namespace

/// Where everything is in one configuration, world frame. On the stack: checks allocate nothing.
struct CollisionChecker::State {
  Pose T_world_link[kMaxMovingLinks];
  Vec3 centres[kMaxSpheres];
  Vec3 bounds[kMaxArmLinks];  // centres of the arm links' bounding spheres
};

CollisionChecker::CollisionChecker(const RobotModel& robot, const TrolleyState& trolley,
                                   const CollisionOptions& options)
    : robot_(&robot), options_(options) {
  CANOPEER_CHECK(options.map_padding_m >= 0.0 && options.self_padding_m >= 0.0,
                 "padding must not be negative");
  padding_.map.fill(options.map_padding_m);
  padding_.self.fill(options.self_padding_m);
  padding_.refine_below_m = kRefineBelowM;
  padding_.refine_map_below_m = options.map_padding_m;
  std::vector<Pose> T_world_link;
  robot.link_poses(Configuration::Zero(robot.dof()), trolley, T_world_link);
  T_world_root_ = T_world_link[static_cast<std::size_t>(robot.moving_root())];
  double excess_m = options.sphere_excess_m;
  while (!collect_arm_links(excess_m)) excess_m *= 1.5;
  collect_obstacles(T_world_link);
  add_motion_of_followers();
  collect_groups();
  collect_reaches();
}

/// False: too many spheres.
bool CollisionChecker::collect_arm_links(double sphere_excess_m) {
  arm_links_.clear();
  centres_.clear();
  radii_m_.clear();
  sphere_shapes_.clear();
  max_radius_m_ = 0.0;
  const std::vector<int>& moving = robot_->moving_links();
  for (std::size_t m = 0; m < moving.size(); ++m) {
    const Link& link = robot_->links()[moving[m]];
    if (link.collision.empty()) continue;
    std::vector<Sphere> spheres;
    for (const CollisionShape& shape : link.collision) {
      const auto cover = cover_with_spheres(shape, sphere_excess_m);
      spheres.insert(spheres.end(), cover.begin(), cover.end());
      sphere_shapes_.insert(sphere_shapes_.end(), cover.size(), &shape);
    }
    ArmLink arm_link;
    arm_link.link = moving[m];
    arm_link.moving = static_cast<int>(m);
    arm_link.first_sphere = static_cast<int>(centres_.size());
    arm_link.bound = bounding_sphere(spheres);
    for (const Sphere& sphere : spheres) {
      centres_.push_back(sphere.centre);
      radii_m_.push_back(sphere.radius_m);
      max_radius_m_ = std::max(max_radius_m_, sphere.radius_m);
    }
    if (centres_.size() > kMaxSpheres) return false;
    arm_link.last_sphere = static_cast<int>(centres_.size());
    arm_link.reach_m =
        reach_of(arm_link.link, arm_link.bound.centre.norm() + arm_link.bound.radius_m);
    arm_links_.push_back(std::move(arm_link));
  }
  CANOPEER_CHECK(arm_links_.size() <= kMaxArmLinks, "too many links in the arm");
  return true;
}

// Of two arm links, the one nearer the base stands for itself by its exact shapes, the other by its
// spheres: only the joints in between move them against each other.
void CollisionChecker::collect_obstacles(const std::vector<Pose>& T_world_link) {
  const std::vector<int>& moving = robot_->moving_links();
  for (std::size_t i = 0; i < robot_->links().size(); ++i) {
    const int link = static_cast<int>(i);
    Obstacle obstacle;
    const auto place = std::find(moving.begin(), moving.end(), link);
    if (place != moving.end()) obstacle.moving = static_cast<int>(place - moving.begin());
    for (std::size_t a = 0; a < arm_links_.size(); ++a) {
      const int arm_link = arm_links_[a].link;
      const int nearer = robot_->arm_joints_before(link) - robot_->arm_joints_before(arm_link);
      // Links that follow a joint, each beside the other, may hang on equally many.
      if (robot_->pair_checked(arm_link, link) && (nearer < 0 || (nearer == 0 && link < arm_link)))
        obstacle.arm_links.push_back(static_cast<int>(a));
    }
    if (obstacle.arm_links.empty()) continue;
    for (const CollisionShape& shape : robot_->links()[i].collision) {
      obstacle.shape = shape;
      obstacle.radius_m = shape.half_extents().norm();
      obstacle.centre = shape.T_link_shape.translation();
      if (obstacle.moving < 0) {
        obstacle.centre = T_world_link[i] * obstacle.centre;
        obstacle.T_shape_world = (T_world_link[i] * shape.T_link_shape).inverse();
      }
      obstacles_.push_back(obstacle);
    }
  }
}

// No point of the link is ever farther from a joint's axis than the way along the chain: the part
// of the first hop at right angles to the axis, then the lengths of the others. A joint that others
// follow moves the link about each of their axes too. `own`: how far the link's points are from its
// frame.
std::vector<double> CollisionChecker::reach_of(int link, double own) const {
  const std::vector<RobotModel::Hop> hops = robot_->arm_hops(link);
  std::vector<double> reach_m(static_cast<std::size_t>(robot_->arm_joints_before(link)), 0.0);
  for (auto from = hops.begin(); from != hops.end(); ++from) {
    if (from->share == 0.0) continue;
    double reach = own;
    for (auto hop = from; hop != hops.end(); ++hop) {
      const Vec3 sideways = hop->offset - hop->axis * hop->axis.dot(hop->offset);
      reach += (hop == from ? sideways.norm() : hop->offset.norm()) + hop->slide;
    }
    if (from->slides) reach = 1.0;  // metre for metre
    reach_m[static_cast<std::size_t>(from->joint)] += from->share * reach;
  }
  return reach_m;
}

// What is not carried by the obstacle and does not carry it moves towards it by both their motions.
void CollisionChecker::add_motion_of_followers() {
  if (!robot_->has_followers()) return;
  std::vector<ArmLink> with_both = arm_links_;
  for (const Obstacle& obstacle : obstacles_) {
    if (obstacle.moving < 0) continue;
    const int link = robot_->moving_links()[static_cast<std::size_t>(obstacle.moving)];
    const std::vector<double> reach_m = reach_of(link, obstacle.centre.norm() + obstacle.radius_m);
    for (const int a : obstacle.arm_links) {
      if (robot_->carried_by(arm_links_[a].link, link)) continue;
      for (std::size_t j = 0; j < reach_m.size(); ++j)
        with_both[a].reach_m[j] =
            std::max(with_both[a].reach_m[j], arm_links_[a].reach_m[j] + reach_m[j]);
    }
  }
  arm_links_ = std::move(with_both);
}

void CollisionChecker::set_map(const DistanceField* map) {
  CANOPEER_CHECK(map == nullptr || map->truncation_m() > max_radius_m_ + options_.map_padding_m,
                 "the distance field is truncated below the arm's spheres");
  map_ = map;
}

bool CollisionChecker::measure_map(const State& state, const Required& required,
                                   Clearances& clearances) const {
  if (map_ == nullptr) return true;
  for (std::size_t a = 0; a < arm_links_.size(); ++a) {
    const double enough = std::max(required.map[a], required.refine_map_below_m);
    for (int i = arm_links_[a].first_sphere; i < arm_links_[a].last_sphere; ++i) {
      double clearance = static_cast<double>(map_->distance(state.centres[i])) - radii_m_[i];
      if (clearance < enough) {
        clearance = shape_clearance(state.T_world_link[arm_links_[a].moving], state.centres[i], i,
                                    required.map[a], enough + kShapeMarginM);
        if (clearance < required.map[a]) return false;
      }
      clearances[a] = std::min(clearances[a], clearance);
    }
  }
  return true;
}

/// How far the part of a shape in one of its spheres is from the occupied voxels, at least; no more
/// than `margin_m`; once it is below `required_m` nobody wants to know how far. Voxels farther than
/// that from the sphere are farther from what it holds.
double CollisionChecker::shape_clearance(const Pose& T_world_link, const Vec3& centre, int sphere,
                                         double required_m, double margin_m) const {
  const CollisionShape& shape = *sphere_shapes_[sphere];
  const Pose T_shape_world = (T_world_link * shape.T_link_shape).inverse();
  const Vec3 reach = Vec3::Constant(radii_m_[sphere] + margin_m);
  const double voxel = map_->resolution_m();
  double clearance = margin_m;
  map_->for_each_occupied(Box(centre - reach, centre + reach), [&](const VoxelIndex& index) {
    if (clearance < required_m) return;  // where unknown space blocks there are thousands of them
    clearance = std::min(clearance, cube_distance(shape, T_shape_world * voxel_centre(index, voxel),
                                                  T_shape_world.linear(), voxel / 2.0));
  });
  return clearance;
}

// Coarse to fine: sphere around the shape against sphere around the link, shape against the latter,
// shape against the link's spheres.
bool CollisionChecker::measure_self(const State& state, const Required& required,
                                    Clearances& clearances) const {
  for (const Obstacle& obstacle : obstacles_) {
    const Pose* const T_world_link =
        obstacle.moving < 0 ? nullptr : &state.T_world_link[obstacle.moving];
    const Vec3 centre = T_world_link == nullptr ? obstacle.centre : *T_world_link * obstacle.centre;
    Pose T_shape_world = Pose::Identity();
    bool placed = false;
    for (const int a : obstacle.arm_links) {
      const ArmLink& arm_link = arm_links_[a];
      const double enough = std::max(required.self[a], required.refine_below_m);
      double clearance =
          (centre - state.bounds[a]).norm() - obstacle.radius_m - arm_link.bound.radius_m;
      if (clearance < enough) {
        if (!placed) {
          T_shape_world = T_world_link == nullptr
                              ? obstacle.T_shape_world
                              : (*T_world_link * obstacle.shape.T_link_shape).inverse();
          placed = true;
        }
        clearance = signed_distance(obstacle.shape, T_shape_world * state.bounds[a]) -
                    arm_link.bound.radius_m;
      }
      if (clearance < enough) {
        clearance = kFarM;
        for (int i = arm_link.first_sphere; i < arm_link.last_sphere; ++i)
          clearance = std::min(
              clearance,
              signed_distance(obstacle.shape, T_shape_world * state.centres[i]) - radii_m_[i]);
      }
      if (clearance < required.self[a]) return false;
      clearances[a] = std::min(clearances[a], clearance);
    }
  }
  return true;
}

bool CollisionChecker::measure(const Configuration& q, const Required& required,
                               Clearances& clearances) const {
  clearances.fill(kFarM);
  State state;
  robot_->moving_link_poses(q, T_world_root_, state.T_world_link);
  for (std::size_t a = 0; a < arm_links_.size(); ++a) {
    const ArmLink& arm_link = arm_links_[a];
    const Pose& T_world_link = state.T_world_link[arm_link.moving];
    state.bounds[a] = T_world_link * arm_link.bound.centre;
    for (int i = arm_link.first_sphere; i < arm_link.last_sphere; ++i)
      state.centres[i] = T_world_link * centres_[i];
  }
  return measure_map(state, required, clearances) && measure_self(state, required, clearances);
}

bool CollisionChecker::edge_free(const Configuration& a, const Configuration& b,
                                 int* states_checked) const {
  int unused = 0;
  const StraightCurve line{a, b};
  return sweep(line, line.speed(), padding_, states_checked == nullptr ? unused : *states_checked);
}

bool CollisionChecker::arc_free(const BlendedPath::Piece& arc, int* states_checked) const {
  int unused = 0;
  const ArcCurve curve{arc};
  return sweep(curve, curve.speed(), padding_,
               states_checked == nullptr ? unused : *states_checked);
}

bool CollisionChecker::escape_free(const Configuration& start, const Configuration& to,
                                   int* states_checked) const {
  int unused = 0;
  int& checked = states_checked == nullptr ? unused : *states_checked;
  checked += 2;
  if (!state_free(to)) return false;
  constexpr double kAnything = -1.0;  // no link is deeper in anything than a metre
  Required required = padding_;
  required.map.fill(kAnything);
  required.self.fill(kAnything);
  Clearances at_start;
  if (!measure(start, required, at_start)) return false;
  for (std::size_t i = 0; i < arm_links_.size(); ++i) {
    required.map[i] = std::min(options_.map_padding_m, at_start[i] - kSmallestMotionM);
    required.self[i] = std::min(options_.self_padding_m, at_start[i] - kSmallestMotionM);
  }
  const StraightCurve line{start, to};
  return sweep(line, line.speed(), required, checked);
}

/// `speed`: no joint moves faster than this per unit of the curve's parameter.
template <typename Curve>
bool CollisionChecker::sweep(const Curve& curve, const Configuration& speed,
                             const Required& required, int& states_checked) const {
  struct Interval {
    double from = 0.0;
    double to = 1.0;
    Clearances at_from;
    Clearances at_to;
  };
  const Configuration a = curve.at(0.0);
  const Configuration b = curve.at(1.0);
  if (!robot_->within_limits(a) || !robot_->within_limits(b)) return false;
  Interval whole;
  states_checked += 1;
  if (!measure(a, required, whole.at_from)) return false;
  states_checked += 1;
  if (!measure(b, required, whole.at_to)) return false;

  // What any point of each arm link moves at most from a to b.
  Clearances motion{};
  for (std::size_t i = 0; i < arm_links_.size(); ++i) {
    for (std::size_t joint = 0; joint < arm_links_[i].reach_m.size(); ++joint)
      motion[i] += speed[static_cast<int>(joint)] * arm_links_[i].reach_m[joint];
  }
  const auto covered = [&](const Interval& interval) {
    const double length = interval.to - interval.from;
    for (std::size_t i = 0; i < arm_links_.size(); ++i) {
      const double moved = motion[i] * length;
      if (moved > kSmallestMotionM && moved > interval.at_from[i] + interval.at_to[i]) return false;
    }
    return true;
  };

  // Breadth first, so that a blocked edge is found out early.
  thread_local std::vector<Interval> open;  // keeps its room from call to call
  open.clear();
  if (!covered(whole)) open.push_back(whole);
  for (std::size_t next = 0; next < open.size(); ++next) {
    const Interval interval = open[next];
    const double middle = (interval.from + interval.to) / 2.0;
    Clearances at_middle;
    states_checked += 1;
    if (!measure(curve.at(middle), required, at_middle)) return false;
    for (const Interval& half : {Interval{interval.from, middle, interval.at_from, at_middle},
                                 Interval{middle, interval.to, at_middle, interval.at_to}}) {
      if (!covered(half)) open.push_back(half);
    }
  }
  return true;
}

}  // namespace canopeer
