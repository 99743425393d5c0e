#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/robot/configuration.h"
#include "canopeer/robot/endless_joints.h"
#include "canopeer/robot/joint_limits.h"
#include "canopeer/robot/kinematics/arm_chain.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Where the trolley stands and how high the arm is lifted.
struct TrolleyState {
  double travel_m = 0.0;  ///< along the row
  double lift_m = 0.0;
};

/// The part a description's links and joints play, and where the robot stands.
struct RobotSetup {
  std::vector<std::string> arm_joints;  ///< from base to tool, revolute or prismatic (a rail)
  std::string base_link;                ///< frame in which boxes and views are given
  std::string camera_frame;             ///< optical frame: z forward, y down
  std::string travel_joint;             ///< prismatic; empty: no such axis
  std::string lift_joint;               ///< prismatic; empty: no such axis
  Pose T_world_root = Pose::Identity();
  /// Where joints stand that nothing here moves, rad or m. Others stand at 0, or at their limit
  /// next to it.
  std::map<std::string, double> standing;
  std::map<std::string, Pose> standing_poses;  ///< the same of planar and floating joints
  std::map<std::string, Configuration, std::less<>> home;  ///< named states, e.g. "side_1"
  std::vector<Box> workspace;        ///< one per side: where the camera may be, arm base frame
  std::vector<Box> sampling_region;  ///< one per side: where targets are, arm base frame
  Box known_free;  ///< where nothing but the robot is, arm base frame; counts where unknown space
                   ///< blocks. Empty: no such place is known
};

/// Kinematics of an arm with a camera on a trolley. Const members are safe to call from several
/// threads.
class RobotModel {
 public:
  /// Checks that the description is one tree, and that the setup's names are in it with the right
  /// types. Arm joints must have limits (revolute ones may turn without end), and home states must
  /// lie within them; one that is out by no more than kLimitTolerance is moved to the limit. The
  /// error names all that is wrong with the joints. What is odd is added to the description's
  /// notices.
  [[nodiscard]] static Expected<RobotModel> make(RobotDescription description, RobotSetup setup);

  [[nodiscard]] int dof() const { return static_cast<int>(limits_.lower.size()); }
  [[nodiscard]] JointType arm_joint_type(int joint) const { return nodes_[arm_nodes_[joint]].type; }
  [[nodiscard]] const JointLimits& limits() const { return limits_; }
  /// The limits, with −π … π for joints that turn without end: each place once. To draw from.
  [[nodiscard]] const JointLimits& span() const { return span_; }
  /// Every motion of the arm takes 1/speed as long from now on, on the same path: its limits of
  /// velocity are `speed` (0, 1] of what they were, those of acceleration the square of it.
  void slow_down(double speed);
  /// Which joints turn without end.
  [[nodiscard]] const EndlessJoints& endless() const { return endless_; }
  /// Up to kLimitTolerance.
  [[nodiscard]] bool within_limits(const Configuration& q) const;
  [[nodiscard]] const RobotSetup& setup() const { return setup_; }
  [[nodiscard]] const RobotDescription& description() const { return description_; }

  /// Limits of the trolley's axes (m, m/s, m/s²); a fixed axis has lower = upper = 0.
  [[nodiscard]] const Joint& travel_axis() const { return travel_axis_; }
  [[nodiscard]] const Joint& lift_axis() const { return lift_axis_; }

  /// Pose of the arm base frame, in which boxes, views and home states are given.
  [[nodiscard]] Pose T_world_base(const TrolleyState& trolley) const;

  /// Forward kinematics to the camera's optical frame.
  [[nodiscard]] Pose T_base_camera(const Configuration& q) const;

  using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxArmJoints>;
  /// The same, and how the camera moves with each joint: its position (rows 0 … 2) and its
  /// orientation (rows 3 … 5). Both in the arm base frame. Allocates nothing.
  void camera_jacobian(const Configuration& q, Pose& T_base_camera, Jacobian& jacobian) const;

  /// A joint's axis as a line in the arm base frame.
  struct AxisLine {
    Vec3 point = Vec3::Zero();
    Vec3 direction = Vec3::UnitZ();
    JointType type = JointType::kRevolute;
  };
  /// The axes of the arm joints, base to tool, at `q`.
  [[nodiscard]] std::vector<AxisLine> arm_axes(const Configuration& q) const;

  /// One stretch of the chain: what lies between two joints, seen from the first.
  struct Hop {
    int joint = -1;      ///< arm joint that moves the frame it starts at; −1: a fixed frame
    double share = 0.0;  ///< by how much: 1, or the size of a following joint's multiplier
    bool slides = false;
    Vec3 offset = Vec3::Zero();  ///< from that frame's origin to the next frame's, m
    Vec3 axis = Vec3::UnitZ();   ///< axis of the joint that moves it, in the same frame
    double slide = 0.0;          ///< what a prismatic joint at the end adds at most, m
  };
  /// The stretches from the base link to `link`, fixed joints on the way included. The first leads
  /// to the first joint that moves with the arm; the last starts at the link itself and has no
  /// length.
  [[nodiscard]] std::vector<Hop> arm_hops(int link) const;
  /// Whether joints follow arm joints (URDF: mimic).
  [[nodiscard]] bool has_followers() const { return has_followers_; }
  /// Whether moving `link_b` always takes `link_a` along.
  [[nodiscard]] bool carried_by(int link_a, int link_b) const;

  /// How a link sits on its parent: T_parent_link = T_parent_joint · motion(position about or along
  /// axis), position = multiplier · (what drives it) + offset.
  struct Mount {
    enum class Driver { none, arm, travel, lift };
    int parent = -1;  ///< index of a link; −1: the root
    Pose T_parent_joint = Pose::Identity();
    JointType type = JointType::kFixed;  ///< kFixed, kRevolute or kPrismatic
    Vec3 axis = Vec3::UnitZ();           ///< joint frame
    Driver driver = Driver::none;
    int arm_joint = -1;  ///< which, when an arm joint drives it
    double multiplier = 1.0;
    double offset = 0.0;
  };
  /// For people who draw the robot or do its kinematics elsewhere.
  [[nodiscard]] Mount mount(int link) const;

  /// Links in an order in which parents come before children; link indices below refer to it.
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  /// Index of a link; −1 when there is none of that name.
  [[nodiscard]] int link_index(std::string_view name) const;
  /// It moves with none but arm joints 0 … n − 1: those between base and link, and what joints on
  /// the way follow. 0: it does not move with the arm.
  [[nodiscard]] int arm_joints_before(int link) const { return nodes_[link].arm_joints_before; }
  /// Whether the two links can collide: rigidly joined and disabled pairs cannot.
  [[nodiscard]] bool pair_checked(int link_a, int link_b) const;

  /// Whether nothing moves the two links against each other.
  [[nodiscard]] bool rigidly_joined(int link_a, int link_b) const {
    return nodes_[link_a].rigid_group == nodes_[link_b].rigid_group;
  }
  /// Whether only one moving joint lies between the two links, or several with nothing in between
  /// that has a collision shape.
  [[nodiscard]] bool joined_by_a_joint(int link_a, int link_b) const;

  /// World poses of all links; `T_world_link` is resized to links().size().
  void link_poses(const Configuration& q, const TrolleyState& trolley,
                  std::vector<Pose>& T_world_link) const;
  /// Only the links that move with the arm; the others must hold the poses of link_poses().
  void arm_link_poses(const Configuration& q, std::vector<Pose>& T_world_link) const;

  /// The links that move with the arm, parents first.
  [[nodiscard]] const std::vector<int>& moving_links() const { return moving_links_; }
  /// The link they all hang on.
  [[nodiscard]] int moving_root() const { return moving_root_; }
  /// Poses of moving_links() in that order, given the one of moving_root(). Allocates nothing; `T`
  /// has room for moving_links().size() poses.
  void moving_link_poses(const Configuration& q, const Pose& T_root, Pose* T) const {
    moving_chain_.poses(q, T_root, T);
  }

  /// A body is what nothing moves against each other, as one piece. Each arm joint carries one, and
  /// each joint that follows one (decision 49). Parents come first.
  [[nodiscard]] int bodies() const { return body_chain_.size(); }
  static constexpr int kMaxBodies = kMaxArmJoints + ArmChain::kMaxFollowers;
  /// Poses of the bodies, those of body_link(), given the one of the base link. Allocates nothing;
  /// `T` has room for bodies() poses.
  void body_poses(const Configuration& q, const Pose& T_world_base, Pose* T) const {
    body_chain_.poses(q, T_world_base, T);
  }
  /// The body a link is part of; −1: it does not move with the arm.
  [[nodiscard]] int body_of(int link) const { return nodes_[link].body; }
  /// The link at the root of a body, which the joint carries.
  [[nodiscard]] int body_link(int body) const {
    return body_links_[static_cast<std::size_t>(body)];
  }
  /// Of a link that moves with the arm: where it sits in its body.
  [[nodiscard]] Pose T_body_link(int link) const;

  /// A named home state; the name must exist (see has_home).
  [[nodiscard]] const Configuration& home(std::string_view name) const;
  [[nodiscard]] bool has_home(std::string_view name) const;
  /// Boxes of a side (1, 2, …) in the arm base frame; the side must exist.
  [[nodiscard]] const Box& workspace(int side) const;
  [[nodiscard]] const Box& sampling_region(int side) const;
  [[nodiscard]] int sides() const { return static_cast<int>(setup_.workspace.size()); }

 private:
  enum class Drive { kNone, kArm, kTravel, kLift };
  struct Node {  // one link and the joint that carries it
    int parent = -1;
    Pose T_parent_joint = Pose::Identity();
    Vec3 axis = Vec3::UnitZ();
    JointType type = JointType::kFixed;
    Drive drive = Drive::kNone;
    int arm_joint = -1;
    bool follows = false;  // at multiplier · position + offset of what drives it
    double multiplier = 1.0;
    double offset = 0.0;
    int own_joints_before = 0;  // arm joints between base and link
    int arm_joints_before = 0;
    int rigid_group = 0;
    int body = -1;
  };
  struct Mover {  // a segment of camera_chain_
    int node = 0;
    bool first = true;  // that its arm joint moves
  };

  RobotModel() = default;
  [[nodiscard]] Expected<void> order_links();
  [[nodiscard]] Expected<void> assign_roles();
  [[nodiscard]] Expected<void> find_paths();
  [[nodiscard]] Expected<void> check_setup();
  [[nodiscard]] Expected<void> compile_chains();
  [[nodiscard]] std::vector<Pose> place_on_carriers() const;
  int add_to_chain(ArmChain& chain, int parent, const Pose& T_parent_joint, const Node& node) const;
  void collect_pairs();
  void leave_neighbours_out();
  [[nodiscard]] Pose T_parent_link(const Node& node, const TrolleyState& trolley) const;

  RobotDescription description_;
  RobotSetup setup_;
  JointLimits limits_;
  JointLimits span_;
  EndlessJoints endless_;
  bool has_followers_ = false;
  Joint travel_axis_;
  Joint lift_axis_;
  std::vector<Link> links_;
  std::vector<Node> nodes_;       // parallel to links_
  std::vector<int> arm_nodes_;    // nodes carried by the arm joints, base to tool
  std::vector<int> camera_path_;  // nodes from below the base link to the camera frame
  std::vector<int> base_path_;    // nodes from the root to the base link
  std::vector<char> pair_checked_;
  std::vector<char> group_has_shape_;  // of the rigid group named after each link
  ArmChain moving_chain_;              // parallel to moving_links_
  std::vector<int> moving_links_;
  int moving_root_ = 0;
  ArmChain body_chain_;  // a segment per body, seen from the base link
  std::vector<int> body_links_;
  std::vector<Pose> T_carrier_link_;  // in its body, or in the base link if it rests (trolley at 0)
  ArmChain camera_chain_;             // a segment per moving joint, seen from the base link
  std::vector<Mover> camera_movers_;  // parallel to it
  Pose T_last_camera_ = Pose::Identity();
};

/// Σ|Δq|, rad: the joint distance of the paper's thresholds. A metre of a prismatic joint counts as
/// a radian: a radian moves the camera of an arm stretched out by a metre that far. It is the
/// length of the motion from `a` to `b`; how far two places are from each other:
/// EndlessJoints::distance.
[[nodiscard]] double joint_distance(const Configuration& a, const Configuration& b);

}  // namespace canopeer
