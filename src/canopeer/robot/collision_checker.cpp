#include "canopeer/robot/collision_checker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/robot/collision/convex_gap.h"

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

/// Where everything is in one configuration, world frame.
struct CollisionChecker::State {
  Pose T_world_body[RobotModel::kMaxBodies];
  const Vec3* centres = nullptr;  // of the spheres
  const Vec3* bounds = nullptr;   // centres of the arm links' bounding spheres
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
  T_world_base_ = robot.T_world_base(trolley);
  double excess_m = options.sphere_excess_m;
  while (!collect_arm_links(excess_m)) excess_m *= 1.5;
  std::vector<Pose> T_world_link;
  robot.link_poses(Configuration::Zero(robot.dof()), trolley, T_world_link);
  collect_obstacles(T_world_link);
  add_motion_of_followers();
  collect_groups();
  collect_reaches();
}

/// False: too many spheres, and coarser ones would be fewer.
bool CollisionChecker::collect_arm_links(double sphere_excess_m) {
  arm_links_.clear();
  centres_.clear();
  radii_m_.clear();
  arm_shapes_.clear();
  sphere_shapes_.clear();
  for (const int index : robot_->moving_links()) {
    const Link& link = robot_->links()[index];
    if (link.collision.empty()) continue;
    ArmLink arm_link;
    arm_link.link = index;
    arm_link.body = robot_->body_of(index);
    arm_link.first_sphere = static_cast<int>(centres_.size());
    const Pose T_body_link = robot_->T_body_link(index);
    std::vector<Sphere> spheres;
    for (const CollisionShape& shape : link.collision) {
      const auto cover = cover_with_spheres(shape, sphere_excess_m);
      spheres.insert(spheres.end(), cover.begin(), cover.end());
      sphere_shapes_.insert(sphere_shapes_.end(), cover.size(),
                            static_cast<int>(arm_shapes_.size()));
      arm_shapes_.push_back(shape);
      arm_shapes_.back().T_link_shape = T_body_link * shape.T_link_shape;
    }
    for (const Sphere& sphere : spheres) {
      centres_.push_back(T_body_link * sphere.centre);
      radii_m_.push_back(sphere.radius_m);
    }
    if (centres_.size() > std::max<std::size_t>(kMaxSpheres, 2 * arm_shapes_.size())) return false;
    arm_link.last_sphere = static_cast<int>(centres_.size());
    arm_link.bound = bounding_sphere(spheres);
    arm_link.reach_m = reach_of(index, arm_link.bound.centre.norm() + arm_link.bound.radius_m);
    arm_link.bound.centre = T_body_link * arm_link.bound.centre;
    arm_links_.push_back(std::move(arm_link));
  }
  const bool one_part_a_link = arm_links_.size() <= kMaxParts;
  parts_ = one_part_a_link ? static_cast<int>(arm_links_.size()) : robot_->bodies();
  for (std::size_t a = 0; a < arm_links_.size(); ++a)
    arm_links_[a].part = one_part_a_link ? static_cast<int>(a) : arm_links_[a].body;
  return true;
}

// Of two arm links, the one nearer the base stands for itself by its exact shapes, the other by its
// spheres: only the joints in between move them against each other.
void CollisionChecker::collect_obstacles(const std::vector<Pose>& T_world_link) {
  for (std::size_t i = 0; i < robot_->links().size(); ++i) {
    const int link = static_cast<int>(i);
    Obstacle obstacle;
    obstacle.body = robot_->body_of(link);
    for (std::size_t a = 0; a < arm_links_.size(); ++a) {
      if (robot_->pair_checked(arm_links_[a].link, link) && arm_links_[a].body > obstacle.body)
        obstacle.arm_links.push_back(static_cast<int>(a));
    }
    if (obstacle.arm_links.empty()) continue;
    for (const CollisionShape& shape : robot_->links()[i].collision) {
      obstacle.shape = shape;
      obstacle.radius_m = shape.half_extents().norm();
      if (obstacle.body >= 0) {
        obstacle.shape.T_link_shape = robot_->T_body_link(link) * shape.T_link_shape;
        obstacle.centre = obstacle.shape.T_link_shape.translation();
      } else {
        obstacle.centre = T_world_link[i] * shape.T_link_shape.translation();
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
Configuration CollisionChecker::reach_of(int link, double own) const {
  const std::vector<RobotModel::Hop> hops = robot_->arm_hops(link);
  Configuration reach_m = Configuration::Zero(robot_->dof());
  for (auto from = hops.begin(); from != hops.end(); ++from) {
    if (from->share == 0.0) continue;
    double reach = own;
    for (auto hop = from; hop != hops.end(); ++hop) {
      const Vec3 sideways = hop->offset - hop->axis * hop->axis.dot(hop->offset);
      reach += (hop == from ? sideways.norm() : hop->offset.norm()) + hop->slide;
    }
    if (from->slides) reach = 1.0;  // metre for metre
    reach_m[from->joint] += from->share * reach;
  }
  return reach_m;
}

// What is not carried by the obstacle and does not carry it moves towards it by both their motions.
void CollisionChecker::add_motion_of_followers() {
  if (!robot_->has_followers()) return;
  std::vector<ArmLink> with_both = arm_links_;
  for (const Obstacle& obstacle : obstacles_) {
    if (obstacle.body < 0) continue;
    const int body_link = robot_->body_link(obstacle.body);
    const Configuration of_obstacle =
        reach_of(body_link, obstacle.centre.norm() + obstacle.radius_m);
    for (const int a : obstacle.arm_links) {
      const ArmLink& arm_link = arm_links_[static_cast<std::size_t>(a)];
      if (robot_->carried_by(arm_link.link, body_link)) continue;
      Configuration& reach_m = with_both[static_cast<std::size_t>(a)].reach_m;
      reach_m = reach_m.cwiseMax(arm_link.reach_m + of_obstacle);
    }
  }
  arm_links_ = std::move(with_both);
}

void CollisionChecker::set_map(const DistanceField* map) { map_ = map; }

bool CollisionChecker::measure_map(const State& state, const Required& required,
                                   Clearances& clearances) const {
  if (map_ == nullptr) return true;
  for (const ArmLink& arm_link : arm_links_) {
    const int part = arm_link.part;
    const double enough = std::max(required.map[part], required.refine_map_below_m);
    for (int i = arm_link.first_sphere; i < arm_link.last_sphere; ++i) {
      double clearance = static_cast<double>(map_->distance(state.centres[i])) - radii_m_[i];
      if (clearance < enough) {
        clearance = shape_clearance(state.T_world_body[arm_link.body], state.centres[i], i,
                                    required.map[part], enough + kShapeMarginM);
        if (clearance < required.map[part]) return false;
      }
      clearances[part] = std::min(clearances[part], clearance);
    }
  }
  return true;
}

/// How far the part of a shape in one of its spheres is from the occupied voxels, at least; no more
/// than `margin_m`; once it is below `required_m` nobody wants to know how far. Voxels farther than
/// that from the sphere are farther from what it holds.
double CollisionChecker::shape_clearance(const Pose& T_world_body, const Vec3& centre, int sphere,
                                         double required_m, double margin_m) const {
  const CollisionShape& shape = arm_shapes_[sphere_shapes_[sphere]];
  const Pose T_shape_world = (T_world_body * shape.T_link_shape).inverse();
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

bool CollisionChecker::has_mesh(const Obstacle& obstacle, int arm_shape) const {
  return obstacle.shape.kind == ShapeKind::kMesh || arm_shapes_[arm_shape].kind == ShapeKind::kMesh;
}

/// Between a shape of the arm and an obstacle, at least. `T_shape_body`: the arm's body seen from
/// the obstacle's shape.
double CollisionChecker::mesh_gap(const Obstacle& obstacle, int arm_shape,
                                  const Pose& T_shape_body) const {
  const CollisionShape& own = arm_shapes_[arm_shape];
  return convex_gap(obstacle.shape, own, T_shape_body * own.T_link_shape);
}

// Coarse to fine: sphere around the shape against sphere around the link, shape against the latter,
// shape against the link's spheres; where a mesh is concerned and those say no, solid against
// solid.
bool CollisionChecker::measure_self(const State& state, const Required& required,
                                    Clearances& clearances) const {
  for (const Obstacle& obstacle : obstacles_) {
    const Pose* const T_world_body =
        obstacle.body < 0 ? nullptr : &state.T_world_body[obstacle.body];
    const Vec3 centre = T_world_body == nullptr ? obstacle.centre : *T_world_body * obstacle.centre;
    Pose T_shape_world = Pose::Identity();
    bool placed = false;
    for (const int a : obstacle.arm_links) {
      const ArmLink& arm_link = arm_links_[a];
      const int part = arm_link.part;
      const double enough = std::max(required.self[part], required.refine_below_m);
      double clearance =
          (centre - state.bounds[a]).norm() - obstacle.radius_m - arm_link.bound.radius_m;
      if (clearance < enough) {
        if (!placed) {
          T_shape_world = T_world_body == nullptr
                              ? obstacle.T_shape_world
                              : (*T_world_body * obstacle.shape.T_link_shape).inverse();
          placed = true;
        }
        clearance = signed_distance(obstacle.shape, T_shape_world * state.bounds[a]) -
                    arm_link.bound.radius_m;
      }
      if (clearance < enough) {
        clearance = kFarM;
        int asked = -1;  // the shape whose gap is known
        double gap = 0.0;
        for (int i = arm_link.first_sphere; i < arm_link.last_sphere; ++i) {
          double own =
              signed_distance(obstacle.shape, T_shape_world * state.centres[i]) - radii_m_[i];
          if (own < enough && has_mesh(obstacle, sphere_shapes_[i])) {
            if (asked != sphere_shapes_[i]) {
              asked = sphere_shapes_[i];
              gap = mesh_gap(obstacle, asked, T_shape_world * state.T_world_body[arm_link.body]);
            }
            own = std::max(own, gap);
          }
          clearance = std::min(clearance, own);
        }
      }
      if (clearance < required.self[part]) return false;
      clearances[part] = std::min(clearances[part], clearance);
    }
  }
  return true;
}

bool CollisionChecker::measure(const Configuration& q, const Required& required,
                               Clearances& clearances) const {
  clearances.fill(kFarM);
  State state;
  robot_->body_poses(q, T_world_base_, state.T_world_body);
  thread_local std::vector<Vec3> room;  // keeps its room from call to call
  room.resize(centres_.size() + arm_links_.size());
  Vec3* const bounds = room.data() + centres_.size();
  for (std::size_t a = 0; a < arm_links_.size(); ++a) {
    const ArmLink& arm_link = arm_links_[a];
    const Pose& T_world_body = state.T_world_body[arm_link.body];
    bounds[a] = T_world_body * arm_link.bound.centre;
    for (int i = arm_link.first_sphere; i < arm_link.last_sphere; ++i)
      room[static_cast<std::size_t>(i)] = T_world_body * centres_[i];
  }
  state.centres = room.data();
  state.bounds = bounds;
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
  for (int i = 0; i < parts_; ++i) {
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

  // What any point of each part moves at most from a to b.
  Clearances motion{};
  for (const ArmLink& arm_link : arm_links_) {
    double moved = 0.0;
    for (int joint = 0; joint < speed.size(); ++joint)
      moved += speed[joint] * arm_link.reach_m[joint];
    motion[arm_link.part] = std::max(motion[arm_link.part], moved);
  }
  const auto covered = [&](const Interval& interval) {
    const double length = interval.to - interval.from;
    for (int i = 0; i < parts_; ++i) {
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
