#pragma once

#include <array>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/sphere_cover.h"
#include "canopeer/robot/timing/blended_path.h"

namespace canopeer {

class DistanceField;

/// What clearance a state of the arm must keep to be free.
struct CollisionOptions {
  double map_padding_m = 0.005;    ///< clearance kept from occupied voxels
  double self_padding_m = 0.005;   ///< clearance kept between links, and from the trolley
  bool unknown_blocks = false;     ///< space never observed is kept away from like occupied voxels,
                                   ///< but for RobotSetup::known_free; the distance field is made
                                   ///< accordingly
  double sphere_excess_m = 0.008;  ///< how far the spheres may stick out of the links sideways
};

/// Fast, conservative collision test of one arm on a standing trolley. Links as spheres are held
/// against the other links' exact shapes and against a distance field of the map. Where a sphere
/// comes too near the map, the link's shape itself is held against the voxels around. What it calls
/// free is free on the true geometry. It may reject states that miss a voxel by the padding, or
/// another link by the padding plus the spheres' excess; of meshes it asks the convex solids first.
/// Any number of links and shapes: what nothing moves against each other is placed as one body.
/// Allocates nothing but once per thread. Const members are safe to call from several threads.
class CollisionChecker {
 public:
  /// `robot` must outlive the checker.
  CollisionChecker(const RobotModel& robot, const TrolleyState& trolley,
                   const CollisionOptions& options = {});

  /// The map to avoid; null: none. It must outlive its use here. Where its truncation distance does
  /// not exceed the largest sphere's radius and map_padding_m together, checks are right and slow.
  void set_map(const DistanceField* map);

  /// No collision with the robot itself, the trolley or the map, and within the joint limits.
  [[nodiscard]] bool state_free(const Configuration& q) const;

  /// Whether the straight joint-space motion a → b is free throughout, ends included. It is not
  /// sampled: an interval is passed only when the clearances at its two ends exceed what any point
  /// of a link can move in between (Schwarzer, Saha, Latombe 2005). So nothing thin is stepped
  /// over. Each state looked at is added to `states_checked` when given.
  [[nodiscard]] bool edge_free(const Configuration& a, const Configuration& b,
                               int* states_checked = nullptr) const;

  /// The same along an arc that rounds the corner of a path.
  [[nodiscard]] bool arc_free(const BlendedPath::Piece& arc, int* states_checked = nullptr) const;

  /// The same for a start that is not free itself, because of what the map learnt since the arm
  /// went there. On the way no link comes nearer to anything than it is at `start` (or its
  /// padding). At `to` all is free. Below the padding the way is looked at every millimetre.
  [[nodiscard]] bool escape_free(const Configuration& start, const Configuration& to,
                                 int* states_checked = nullptr) const;

  [[nodiscard]] const CollisionOptions& options() const { return options_; }
  [[nodiscard]] int sphere_count() const { return static_cast<int>(radii_m_.size()); }

 private:
  /// Clearances are kept for so many parts of the arm: each link, or where there are more, each
  /// body.
  static constexpr int kMaxParts = RobotModel::kMaxBodies;
  /// With more of them they are made coarser, down to two a shape.
  static constexpr int kMaxSpheres = 512;
  /// The voxels near a link's shape are looked at this far beyond the clearance asked for. So its
  /// clearance is known a little beyond that too.
  static constexpr double kShapeMarginM = 0.01;
  /// Per part: how far it is from whatever it must not touch, at least; metres.
  using Clearances = std::array<double, kMaxParts>;
  struct ArmLink {
    int link = 0;
    int body = 0;           // of RobotModel::body_poses(), which it is fixed to
    int part = 0;           // whose clearance its own counts for
    int first_sphere = 0;   // in centres_ and radii_m_
    int last_sphere = 0;    // one past
    Sphere bound;           // around all of them, body frame
    Configuration reach_m;  // by how much a radian of each arm joint moves it at most
  };
  struct Obstacle {        // a shape of the robot, trolley included, that arm links can run into
    int body = -1;         // that its link is fixed to; −1: it rests
    CollisionShape shape;  // placed in its body, or in its link if it rests
    Vec3 centre =
        Vec3::Zero();  // of a sphere around the shape: in its body, or in world if it rests
    double radius_m = 0.0;
    Pose T_shape_world = Pose::Identity();  // of one that rests
    std::vector<int> arm_links;             // indices of those that must not touch it
  };
  struct SphereGroup {  // neighbouring spheres of one arm link
    int arm_link = 0;
    int first_sphere = 0;
    int last_sphere = 0;  // one past
    Sphere bound;         // around them
  };
  struct Required {  // clearances to keep
    Clearances map;
    Clearances self;
    double refine_below_m = 0.0;      // bounds on a self-clearance above this need no better one
    double refine_map_below_m = 0.0;  // the same for the map
  };
  struct State;

  bool collect_arm_links(double sphere_excess_m);
  void collect_obstacles(const std::vector<Pose>& T_world_link);
  [[nodiscard]] Configuration reach_of(int link, double own) const;
  void add_motion_of_followers();
  void collect_groups();
  void collect_reaches();
  bool state_free_wide(const Configuration& q) const;
  bool state_free_narrow(const Configuration& q) const;
  bool look_at_state(const Configuration& q) const;
  bool look_at_block(std::size_t first_link, std::size_t count, const Pose* T_world_body,
                     const double*& apart2) const;
  bool group_free(const Pose& T_world_body, const SphereGroup& group) const;
  bool has_mesh(const Obstacle& obstacle, int arm_shape) const;
  double mesh_gap(const Obstacle& obstacle, int arm_shape, const Pose& T_shape_body) const;
  bool pair_free(const Obstacle& obstacle, const ArmLink& arm_link, const Pose* T_world_body) const;
  bool measure(const Configuration& q, const Required& required, Clearances& clearances) const;
  bool measure_self(const State& state, const Required& required, Clearances& clearances) const;
  bool measure_map(const State& state, const Required& required, Clearances& clearances) const;
  double shape_clearance(const Pose& T_world_body, const Vec3& centre, int sphere,
                         double required_m, double margin_m) const;
  template <typename Curve>
  bool sweep(const Curve& curve, const Configuration& speed, const Required& required,
             int& states_checked) const;

  const RobotModel* robot_;
  CollisionOptions options_;
  Required padding_;
  const DistanceField* map_ = nullptr;
  Pose T_world_base_ = Pose::Identity();
  std::vector<ArmLink> arm_links_;
  int parts_ = 0;
  std::vector<Vec3> centres_;  // body frame
  std::vector<double> radii_m_;
  std::vector<CollisionShape> arm_shapes_;  // placed in their bodies
  std::vector<int> sphere_shapes_;          // which of these each sphere helps to cover
  std::vector<Obstacle> obstacles_;
  std::vector<SphereGroup> groups_;
  // Per block of arm links, obstacle and arm link of the block, in steps of four: the squared
  // distance between their bounds from which on they are apart. Negative: they need not be.
  std::vector<double> apart2_m2_;
};

}  // namespace canopeer
