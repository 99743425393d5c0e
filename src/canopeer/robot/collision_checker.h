#pragma once

#include <array>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/sphere_cover.h"

namespace canopeer {

class DistanceField;

struct CollisionOptions {
  double map_padding_m = 0.005;    ///< clearance kept from occupied voxels
  double self_padding_m = 0.005;   ///< clearance kept between links, and from the trolley
  double sphere_excess_m = 0.008;  ///< how far the spheres may stick out of the links sideways
};

/// Fast, conservative collision test of one arm on a standing trolley: links as spheres, against
/// the other links' exact shapes and against a distance field of the map. What it calls free is
/// free on the true geometry; it may reject states that miss an obstacle by the padding plus the
/// spheres' excess. Const members are safe to call from several threads.
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

  /// Whether the straight joint-space motion a → b is free throughout, ends included. Not sampled:
  /// an interval is passed only when the clearances at its two ends exceed what any point of a link
  /// can move in between (Schwarzer, Saha, Latombe 2005), so nothing thin is stepped over. Each
  /// state looked at is added to `states_checked` when given.
  [[nodiscard]] bool edge_free(const Configuration& a, const Configuration& b,
                               int* states_checked = nullptr) const;

  /// The same for a start that is not free itself, because of what the map learnt since the arm
  /// went there: on the way no link comes nearer to anything than it is at `start` (or its
  /// padding), and at `to` all is free. Below the padding the way is looked at every millimetre.
  [[nodiscard]] bool escape_free(const Configuration& start, const Configuration& to,
                                 int* states_checked = nullptr) const;

  [[nodiscard]] double max_sphere_radius_m() const { return max_radius_m_; }

 private:
  static constexpr int kMaxArmLinks = 16;
  /// Per arm link: how far it is from whatever it must not touch, at least; metres.
  using Clearances = std::array<double, kMaxArmLinks>;
  struct ArmLink {
    int link = 0;
    int first_sphere = 0;         // in centres_ and radii_m_
    int last_sphere = 0;          // one past
    Sphere bound;                 // around all of them
    std::vector<double> reach_m;  // per arm joint that moves it: no point is farther from its axis
  };
  struct Obstacle {  // a shape of the robot, trolley included, that arm links can run into
    int link = 0;
    bool moves = false;
    CollisionShape shape;
    std::vector<int> arm_links;  // indices of those that must not touch it
  };
  struct Required {  // clearances to keep
    Clearances map;
    Clearances self;
    double refine_below_m = 0.0;  // bounds on a clearance above this need no better one
  };
  struct State;

  void collect_arm_links();
  void collect_obstacles();
  void measure_reach(ArmLink& arm_link) const;
  bool measure(const Configuration& q, const Required& required, Clearances& clearances) const;
  bool measure_self(const State& state, const Required& required, Clearances& clearances) const;
  bool measure_map(const State& state, const Required& required, Clearances& clearances) const;
  bool sweep(const Configuration& a, const Configuration& b, const Required& required,
             int& states_checked) const;

  const RobotModel* robot_;
  CollisionOptions options_;
  Required padding_;
  const DistanceField* map_ = nullptr;
  std::vector<Pose> resting_poses_;  // of all links in world; those of the arm are overwritten
  std::vector<ArmLink> arm_links_;
  std::vector<Vec3> centres_;  // link frame
  std::vector<double> radii_m_;
  std::vector<Obstacle> obstacles_;
  std::vector<Pose> resting_T_shape_world_;  // parallel to obstacles_, of those that do not move
  double max_radius_m_ = 0.0;
};

}  // namespace canopeer
