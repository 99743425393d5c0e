// RobotModel's kinematics: the chains its links and its camera hang on.

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

int RobotModel::add_to_chain(ArmChain& chain, int parent, const Pose& T_parent_joint,
                             const Node& node) const {
  const int drive = node.drive != Drive::kArm ? -1
                    : node.follows
                        ? chain.add_follower(node.arm_joint, node.multiplier, node.offset)
                        : node.arm_joint;
  return chain.add(parent, T_parent_joint, node.type, node.axis, drive);
}

/// Where each link sits in what carries it: the body it is part of, or else the base link, with the
/// trolley at 0.
std::vector<Pose> RobotModel::place_on_carriers() const {
  const auto base = static_cast<std::size_t>(link_index(setup_.base_link));
  std::vector<Pose> T_root_link(nodes_.size(), Pose::Identity());
  for (std::size_t i = 1; i < nodes_.size(); ++i)
    T_root_link[i] = T_root_link[nodes_[i].parent] * T_parent_link(nodes_[i], {});
  std::vector<Pose> T_carrier_link(nodes_.size(), Pose::Identity());
  std::vector<char> after_base(nodes_.size(), 0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    after_base[i] = i == base || (i > 0 && after_base[node.parent] != 0);
    if (i == base || node.drive == Drive::kArm) continue;
    T_carrier_link[i] = after_base[i] != 0 || node.body >= 0
                            ? T_carrier_link[node.parent] * T_parent_link(node, {})
                            : T_root_link[base].inverse() * T_root_link[i];
  }
  return T_carrier_link;
}

// Three chains: all links that move with the arm, for what looks at links; its bodies, for
// collisions; and the joints before the camera.
Expected<void> RobotModel::compile_chains() {
  const auto followers = std::count_if(nodes_.begin(), nodes_.end(), [](const Node& node) {
    return node.drive == Drive::kArm && node.follows;
  });
  if (followers > ArmChain::kMaxFollowers)
    return fail(std::to_string(followers) + " joints follow arm joints; at most " +
                std::to_string(ArmChain::kMaxFollowers) + " can be handled");
  const auto moves = [&](int index) { return nodes_[index].drive == Drive::kArm; };
  moving_root_ = nodes_[*std::find_if(camera_path_.begin(), camera_path_.end(), moves)].parent;
  moving_chain_ = ArmChain(dof());
  body_chain_ = ArmChain(dof());
  camera_chain_ = ArmChain(dof());

  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    node.body = nodes_[node.parent].body;
    if (node.drive != Drive::kArm) continue;
    if (node.body < 0 && !rigidly_joined(node.parent, moving_root_))
      return fail("link '" + links_[i].name +
                  "' follows an arm joint, but a trolley axis lies between it and the arm");
    node.body = static_cast<int>(body_links_.size());
    body_links_.push_back(static_cast<int>(i));
  }
  T_carrier_link_ = place_on_carriers();
  const auto T_carrier_joint = [&](const Node& node) -> Pose {
    return T_carrier_link_[static_cast<std::size_t>(node.parent)] * node.T_parent_joint;
  };

  std::vector<int> segment_of(nodes_.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.body < 0) continue;
    const bool elsewhere = nodes_[node.parent].body < 0 && node.parent != moving_root_;
    const Pose T_parent_joint =
        elsewhere ? T_carrier_link_[static_cast<std::size_t>(moving_root_)].inverse() *
                        T_carrier_joint(node)
                  : node.T_parent_joint;
    segment_of[i] = add_to_chain(moving_chain_, segment_of[static_cast<std::size_t>(node.parent)],
                                 T_parent_joint, node);
    moving_links_.push_back(static_cast<int>(i));
  }
  for (const int index : body_links_) {
    const Node& node = nodes_[index];
    add_to_chain(body_chain_, nodes_[node.parent].body, T_carrier_joint(node), node);
  }

  std::vector<char> moved(static_cast<std::size_t>(dof()), 0);
  for (const int index : camera_path_) {
    const Node& node = nodes_[index];
    if (node.drive != Drive::kArm) continue;
    add_to_chain(camera_chain_, camera_chain_.size() - 1, T_carrier_joint(node), node);
    camera_movers_.push_back({index, moved[static_cast<std::size_t>(node.arm_joint)] == 0});
    moved[static_cast<std::size_t>(node.arm_joint)] = 1;
  }
  T_last_camera_ = T_carrier_link_[static_cast<std::size_t>(camera_path_.back())];
  return {};
}

Pose RobotModel::T_parent_link(const Node& node, const TrolleyState& trolley) const {
  Pose T = node.T_parent_joint;
  if (node.drive != Drive::kTravel && node.drive != Drive::kLift) return T;
  const double driver = node.drive == Drive::kTravel ? trolley.travel_m : trolley.lift_m;
  const double moved = node.multiplier * driver + node.offset;
  if (moved == 0.0) return T;
  if (node.type == JointType::kRevolute) {
    T.rotate(Eigen::AngleAxisd(moved, node.axis));
  } else {
    T.translate(node.axis * moved);
  }
  return T;
}

RobotModel::Mount RobotModel::mount(int link) const {
  const Node& node = nodes_[link];
  Mount mount{node.parent, node.T_parent_joint, JointType::kFixed, node.axis};
  if (node.drive == Drive::kNone) return mount;
  mount.type = node.type;
  mount.driver = node.drive == Drive::kArm      ? Mount::Driver::arm
                 : node.drive == Drive::kTravel ? Mount::Driver::travel
                                                : Mount::Driver::lift;
  mount.arm_joint = node.arm_joint;
  mount.multiplier = node.multiplier;
  mount.offset = node.offset;
  return mount;
}

Pose RobotModel::T_world_base(const TrolleyState& trolley) const {
  Pose T = setup_.T_world_root;
  for (const int index : base_path_) T = T * T_parent_link(nodes_[index], trolley);
  return T;
}

Pose RobotModel::T_base_camera(const Configuration& q) const {
  CANOPEER_CHECK(q.size() == dof(), "configuration of another arm");
  Pose T[kMaxBodies];
  camera_chain_.poses(q, Pose::Identity(), T);
  return T[camera_chain_.size() - 1] * T_last_camera_;
}

void RobotModel::camera_jacobian(const Configuration& q, Pose& T_base_camera,
                                 Jacobian& jacobian) const {
  Pose T[kMaxBodies];
  camera_chain_.poses(q, Pose::Identity(), T);
  T_base_camera = T[camera_chain_.size() - 1] * T_last_camera_;
  jacobian.resize(6, dof());
  for (std::size_t k = 0; k < camera_movers_.size(); ++k) {
    const Node& node = nodes_[camera_movers_[k].node];
    const Vec3 axis = T[k].linear() * node.axis;
    Eigen::Matrix<double, 6, 1> column;
    if (node.type == JointType::kPrismatic) {
      column << axis, Vec3::Zero();
    } else {
      column << axis.cross(T_base_camera.translation() - T[k].translation()), axis;
    }
    if (node.follows) column *= node.multiplier;
    if (camera_movers_[k].first) {
      jacobian.col(node.arm_joint) = column;
    } else {
      jacobian.col(node.arm_joint) += column;
    }
  }
}

std::vector<RobotModel::AxisLine> RobotModel::arm_axes(const Configuration& q) const {
  Pose T[kMaxBodies];
  camera_chain_.poses(q, Pose::Identity(), T);
  std::vector<AxisLine> axes;
  for (std::size_t k = 0; k < camera_movers_.size(); ++k) {
    const Node& node = nodes_[camera_movers_[k].node];
    if (!node.follows) axes.push_back({T[k].translation(), T[k].linear() * node.axis, node.type});
  }
  return axes;
}

std::vector<RobotModel::Hop> RobotModel::arm_hops(int link) const {
  std::vector<Hop> hops;
  Vec3 offset = Vec3::Zero();  // from the link looked at to the next
  double slide = 0.0;
  while (nodes_[link].body >= 0) {
    const Node& node = nodes_[link];
    const bool moves = node.drive == Drive::kArm;
    Hop hop;
    hop.joint = moves ? node.arm_joint : -1;
    hop.share = !moves ? 0.0 : node.follows ? std::abs(node.multiplier) : 1.0;
    hop.slides = node.type == JointType::kPrismatic;
    hop.offset = offset;
    hop.axis = node.axis;
    hop.slide = slide;
    hops.push_back(hop);
    offset = node.T_parent_joint.translation();
    slide = 0.0;
    if (moves && hop.slides) {
      const int i = node.arm_joint;
      slide = std::max(std::abs(node.multiplier * limits_.lower[i] + node.offset),
                       std::abs(node.multiplier * limits_.upper[i] + node.offset));
    }
    link = node.parent;
  }
  Hop first;
  first.offset = T_carrier_link_[static_cast<std::size_t>(link)] * offset;
  first.slide = slide;
  hops.push_back(first);
  std::reverse(hops.begin(), hops.end());
  return hops;
}

void RobotModel::link_poses(const Configuration& q, const TrolleyState& trolley,
                            std::vector<Pose>& T_world_link) const {
  CANOPEER_CHECK(q.size() == dof(), "configuration of another arm");
  T_world_link.resize(links_.size());
  T_world_link[0] = setup_.T_world_root;
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    if (nodes_[i].arm_joints_before == 0)
      T_world_link[i] = T_world_link[nodes_[i].parent] * T_parent_link(nodes_[i], trolley);
  }
  arm_link_poses(q, T_world_link);
}

void RobotModel::arm_link_poses(const Configuration& q, std::vector<Pose>& T_world_link) const {
  std::vector<Pose> T(moving_links_.size());
  moving_chain_.poses(q, T_world_link[moving_root_], T.data());
  for (std::size_t i = 0; i < moving_links_.size(); ++i) T_world_link[moving_links_[i]] = T[i];
}

}  // namespace canopeer
