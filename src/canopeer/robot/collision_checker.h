#pragma once

#include <array>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/sphere_cover.h"
#include "canopeer/robot/timing/blended_path.h"

namespace canopeer {

class DistanceField;

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
/// another link by the padding plus the spheres' excess. Allocates nothing. Const members are safe
/// to call from several threads.
class CollisionChecker {
 public:
  /// `robot` must outlive the checker.
  CollisionChecker(const RobotModel& robot, const TrolleyState& trolley,
                   const CollisionOptions& options = {});

  /// The map to avoid; null: none. It must outlive its use here. Its truncation distance must
  /// exceed the largest sphere and padding (max_sphere_radius_m() + map_padding_m).
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
  [[nodiscard]] double max_sphere_radius_m() const { return max_radius_m_; }
  [[nodiscard]] int sphere_count() const { return static_cast<int>(radii_m_.size()); }

 private:
  static constexpr int kMaxArmLinks = 24;
  static constexpr int kMaxSpheres = 512;  // more: the spheres are made coarser
  /// The voxels near a link's shape are looked at this far beyond the clearance asked for. So its
  /// clearance is known a little beyond that too.
  static constexpr double kShapeMarginM = 0.01;
  /// Per arm link: how far it is from whatever it must not touch, at least; metres.
  using Clearances = std::array<double, kMaxArmLinks>;
  struct ArmLink {
    int link = 0;
    int moving = 0;               // its place in RobotModel::moving_links()
    int first_sphere = 0;         // in centres_ and radii_m_
    int last_sphere = 0;          // one past
    Sphere bound;                 // around all of them
    std::vector<double> reach_m;  // per arm joint that moves it: no point is farther from its axis
  };
  struct Obstacle {   // a shape of the robot, trolley included, that arm links can run into
    int moving = -1;  // its link's place in RobotModel::moving_links(); −1: it rests
    CollisionShape shape;
    Vec3 centre =
        Vec3::Zero();  // of a sphere around the shape: in its link, or in world if it rests
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
  [[nodiscard]] std::vector<double> reach_of(int link, double own) const;
  void add_motion_of_followers();
  void collect_groups();
  void collect_reaches();
  bool state_free_wide(const Configuration& q) const;
  bool state_free_narrow(const Configuration& q) const;
  bool look_at_state(const Configuration& q) const;
  bool group_free(const Pose& T_world_link, const SphereGroup& group) const;
  bool pair_free(const Obstacle& obstacle, const ArmLink& arm_link, const Pose* T_world_link) const;
  bool measure(const Configuration& q, const Required& required, Clearances& clearances) const;
  bool measure_self(const State& state, const Required& required, Clearances& clearances) const;
  bool measure_map(const State& state, const Required& required, Clearances& clearances) const;
  double shape_clearance(const Pose& T_world_link, const Vec3& centre, int sphere,
                         double required_m, double margin_m) const;
  template <typename Curve>
  bool sweep(const Curve& curve, const Configuration& speed, const Required& required,
             int& states_checked) const;

  const RobotModel* robot_;
  CollisionOptions options_;
  Required padding_;
  const DistanceField* map_ = nullptr;
  Pose T_world_root_ = Pose::Identity();  // of RobotModel::moving_root()
  std::vector<ArmLink> arm_links_;
  std::vector<Vec3> centres_;  // link frame
  std::vector<double> radii_m_;
  std::vector<const CollisionShape*> sphere_shapes_;  // what each sphere helps to cover
  std::vector<Obstacle> obstacles_;
  std::vector<SphereGroup> groups_;
  // Per obstacle and arm link, the links in steps of four: the squared distance between their
  // bounds from which on they are apart. Negative: they need not be.
  std::vector<double> apart2_m2_;
  double max_radius_m_ = 0.0;
};

}  // namespace canopeer
