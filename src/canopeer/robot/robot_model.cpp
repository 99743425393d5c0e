#include "canopeer/robot/robot_model.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

const Joint* find_joint(const RobotDescription& robot, const std::string& name) {
  const auto it = std::find_if(robot.joints.begin(), robot.joints.end(),
                               [&](const Joint& joint) { return joint.name == name; });
  return it == robot.joints.end() ? nullptr : &*it;
}

/// What motions are planned and timed within.
Expected<void> check_limits(const Joint& joint) {
  constexpr double kLargest = 1e4;  // the reach of sin_cos(), with room
  const auto number = [](double value) { return std::isfinite(value); };
  std::string missing;
  const auto want = [&](bool there, const char* what) {
    if (!there) missing += std::string(missing.empty() ? "" : ", ") + what;
  };
  want(number(joint.lower) && number(joint.upper),
       "lower and upper (a continuous joint: make it revolute with a range)");
  want(number(joint.velocity_limit) && joint.velocity_limit > 0.0, "velocity above 0");
  want(number(joint.acceleration_limit) && joint.acceleration_limit > 0.0, "acceleration above 0");
  if (!missing.empty())
    return fail("joint '" + joint.name + "' needs finite limits; missing: " + missing);
  if (joint.lower > joint.upper || joint.lower < -kLargest || joint.upper > kLargest)
    return fail("joint '" + joint.name + "': expected lower <= upper, both within 1e4");
  return {};
}

/// All that is missing at once, so that a robot is mended in one go.
Expected<void> check_all_limits(const RobotDescription& robot, const RobotSetup& setup) {
  std::vector<std::string> driven = setup.arm_joints;
  for (const std::string& axis : {setup.travel_joint, setup.lift_joint}) {
    if (!axis.empty()) driven.push_back(axis);
  }
  std::string wrong;
  for (const std::string& name : driven) {
    const Joint* const joint = find_joint(robot, name);
    if (joint == nullptr) continue;  // said elsewhere
    if (auto limits = check_limits(*joint); !limits)
      wrong += (wrong.empty() ? "" : "; ") + limits.error().message;
  }
  if (!wrong.empty()) return fail(wrong);
  return {};
}

Joint fixed_axis() {
  Joint joint;
  joint.lower = joint.upper = 0.0;
  return joint;
}

}  // namespace

Expected<RobotModel> RobotModel::make(RobotDescription description, RobotSetup setup) {
  RobotModel model;
  model.description_ = std::move(description);
  model.setup_ = std::move(setup);
  if (auto ordered = model.order_links(); !ordered) return fail(ordered.error().message);
  if (auto assigned = model.assign_roles(); !assigned) return fail(assigned.error().message);
  if (auto checked = model.check_setup(); !checked) return fail(checked.error().message);
  model.compile_chains();
  model.collect_pairs();
  return model;
}

// Breadth first from the one link that is nobody's child.
Expected<void> RobotModel::order_links() {
  std::map<std::string, const Joint*> carried_by;
  for (const Joint& joint : description_.joints) {
    if (!carried_by.emplace(joint.child, &joint).second)
      return fail("link '" + joint.child + "' is the child of two joints");
  }
  for (const Link& link : description_.links) {
    if (carried_by.count(link.name) > 0) continue;
    if (!links_.empty())
      return fail("links '" + links_.front().name + "' and '" + link.name +
                  "' both have no parent: the robot must be one tree");
    links_.push_back(link);
    nodes_.emplace_back();
  }
  for (std::size_t parent = 0; parent < links_.size(); ++parent) {
    for (const Link& link : description_.links) {
      const auto it = carried_by.find(link.name);
      if (it == carried_by.end() || it->second->parent != links_[parent].name) continue;
      const Joint& joint = *it->second;
      Node node;
      node.parent = static_cast<int>(parent);
      node.T_parent_joint = joint.T_parent_joint;
      node.axis = joint.axis.normalized();
      node.type = joint.type;
      links_.push_back(link);
      nodes_.push_back(node);
    }
  }
  if (links_.size() != description_.links.size())
    return fail("some links hang on no root: the robot must be one tree");
  return {};
}

Expected<void> RobotModel::assign_roles() {
  const auto axis_node = [&](const std::string& name, bool arm, const char* what,
                             int& index) -> Expected<const Joint*> {
    const Joint* joint = find_joint(description_, name);
    if (joint == nullptr) return fail("no joint is called '" + name + "' (" + what + ")");
    if (joint->type != JointType::kPrismatic && !(arm && joint->type == JointType::kRevolute))
      return fail("joint '" + name + "' must be " + (arm ? "revolute or prismatic" : "prismatic") +
                  " (" + what + ")");
    index = link_index(joint->child);
    return joint;
  };

  if (auto limits = check_all_limits(description_, setup_); !limits)
    return fail(limits.error().message);
  const int dof = static_cast<int>(setup_.arm_joints.size());
  if (dof < 1 || dof > kMaxArmJoints)
    return fail("arm_joints: expected at least 1 and at most " + std::to_string(kMaxArmJoints) +
                " joints, found " + std::to_string(dof));
  limits_.lower.resize(dof);
  limits_.upper.resize(dof);
  limits_.velocity.resize(dof);
  limits_.acceleration.resize(dof);
  for (int i = 0; i < dof; ++i) {
    int index = -1;
    auto joint = axis_node(setup_.arm_joints[i], true, "arm joint", index);
    if (!joint) return fail(joint.error().message);
    if (nodes_[index].drive != Drive::kNone)
      return fail("joint '" + setup_.arm_joints[i] + "' is listed twice");
    nodes_[index].drive = Drive::kArm;
    nodes_[index].arm_joint = i;
    arm_nodes_.push_back(index);
    limits_.lower[i] = (*joint)->lower;
    limits_.upper[i] = (*joint)->upper;
    limits_.velocity[i] = (*joint)->velocity_limit;
    limits_.acceleration[i] = (*joint)->acceleration_limit;
  }
  travel_axis_ = lift_axis_ = fixed_axis();
  for (const bool travel : {true, false}) {
    const std::string& name = travel ? setup_.travel_joint : setup_.lift_joint;
    if (name.empty()) continue;
    int index = -1;
    auto joint = axis_node(name, false, "trolley axis", index);
    if (!joint) return fail(joint.error().message);
    nodes_[index].drive = travel ? Drive::kTravel : Drive::kLift;
    (travel ? travel_axis_ : lift_axis_) = **joint;
  }

  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const Node& parent = nodes_[node.parent];
    node.arm_joints_before = parent.arm_joints_before;
    if (node.drive == Drive::kArm) {
      if (node.arm_joint != parent.arm_joints_before)
        return fail("arm joints must form one chain, listed from base to tool; '" +
                    setup_.arm_joints[node.arm_joint] + "' is out of order");
      ++node.arm_joints_before;
    }
    node.rigid_group = node.drive == Drive::kNone ? parent.rigid_group : static_cast<int>(i);
  }

  const auto path_to = [&](int link, int stop) {
    std::vector<int> path;
    for (; link != stop && link >= 0; link = nodes_[link].parent) path.push_back(link);
    std::reverse(path.begin(), path.end());
    return path;
  };
  const int base = link_index(setup_.base_link);
  const int camera = link_index(setup_.camera_frame);
  if (base < 0) return fail("no link is called '" + setup_.base_link + "' (base_link)");
  if (camera < 0) return fail("no link is called '" + setup_.camera_frame + "' (camera_frame)");
  base_path_ = path_to(base, -1);
  camera_path_ = path_to(camera, base);
  if (!camera_path_.empty() && nodes_[camera_path_.front()].parent != base)
    return fail("the camera frame '" + setup_.camera_frame + "' does not hang on base_link '" +
                setup_.base_link + "'");
  if (nodes_[base].arm_joints_before != 0 || nodes_[camera].arm_joints_before != dof)
    return fail("all arm joints must lie between base_link '" + setup_.base_link +
                "' and camera_frame '" + setup_.camera_frame + "'");
  for (const int index : camera_path_) {
    if (nodes_[index].drive == Drive::kTravel || nodes_[index].drive == Drive::kLift)
      return fail("a trolley axis lies between base_link and camera_frame");
  }
  return {};
}

Expected<void> RobotModel::check_setup() const {
  for (const auto& [name, q] : setup_.home) {
    if (q.size() != dof())
      return fail("home state '" + name + "' needs " + std::to_string(dof()) + " values");
    for (int i = 0; i < dof(); ++i) {
      if (q[i] >= limits_.lower[i] && q[i] <= limits_.upper[i]) continue;
      return fail("home state '" + name + "': joint '" + setup_.arm_joints[i] + "' at " +
                  std::to_string(q[i]) + " is outside its limits " +
                  std::to_string(limits_.lower[i]) + " ... " + std::to_string(limits_.upper[i]));
    }
  }
  if (setup_.workspace.size() != setup_.sampling_region.size())
    return fail("each side needs a workspace and a sampling region");
  for (const auto& boxes : {setup_.workspace, setup_.sampling_region}) {
    for (const Box& box : boxes) {
      if (box.isEmpty()) return fail("a workspace or sampling region is empty");
    }
  }
  for (const auto& [a, b] : description_.disabled_pairs) {
    for (const auto& name : {a, b}) {
      if (link_index(name) < 0) return fail("disabled pair: no link is called '" + name + "'");
    }
  }
  return {};
}

void RobotModel::collect_pairs() {
  const std::size_t n = links_.size();
  group_has_shape_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!links_[i].collision.empty()) group_has_shape_[nodes_[i].rigid_group] = 1;
  }
  pair_checked_.assign(n * n, 0);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      pair_checked_[a * n + b] = nodes_[a].rigid_group != nodes_[b].rigid_group &&
                                 !links_[a].collision.empty() && !links_[b].collision.empty();
    }
  }
  for (const auto& [name_a, name_b] : description_.disabled_pairs) {
    const auto a = static_cast<std::size_t>(link_index(name_a));
    const auto b = static_cast<std::size_t>(link_index(name_b));
    pair_checked_[a * n + b] = pair_checked_[b * n + a] = 0;
  }
  if (description_.neighbours_may_touch) leave_neighbours_out();
}

void RobotModel::leave_neighbours_out() {
  const int n = static_cast<int>(links_.size());
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      if (pair_checked(a, b) && joined_by_a_joint(a, b))
        pair_checked_[static_cast<std::size_t>(a) * links_.size() + static_cast<std::size_t>(b)] =
            pair_checked_[static_cast<std::size_t>(b) * links_.size() +
                          static_cast<std::size_t>(a)] = 0;
    }
  }
}

bool RobotModel::within_limits(const Configuration& q) const {
  return (q.array() >= limits_.lower.array()).all() && (q.array() <= limits_.upper.array()).all();
}

// Two chains: all links that move with the arm, for collisions; and joints only, with what is
// fixed in between folded in, for the camera.
void RobotModel::compile_chains() {
  std::vector<int> segment_of(nodes_.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.arm_joints_before == 0) continue;
    if (moving_links_.empty()) moving_root_ = node.parent;
    segment_of[i] = moving_chain_.add(segment_of[static_cast<std::size_t>(node.parent)],
                                      node.T_parent_joint, node.type, node.axis, node.arm_joint);
    moving_links_.push_back(static_cast<int>(i));
  }
  Pose T_fixed = Pose::Identity();
  for (const int index : camera_path_) {
    const Node& node = nodes_[index];
    T_fixed = T_fixed * node.T_parent_joint;
    if (node.drive != Drive::kArm) continue;
    camera_chain_.add(camera_chain_.size() - 1, T_fixed, node.type, node.axis, node.arm_joint);
    T_fixed = Pose::Identity();
  }
  T_last_camera_ = T_fixed;
}

Pose RobotModel::T_parent_link(const Node& node, const TrolleyState& trolley) const {
  const double travelled = node.drive == Drive::kTravel ? trolley.travel_m
                           : node.drive == Drive::kLift ? trolley.lift_m
                                                        : 0.0;
  Pose T = node.T_parent_joint;
  if (travelled != 0.0) T.translate(node.axis * travelled);
  return T;
}

Pose RobotModel::T_world_base(const TrolleyState& trolley) const {
  Pose T = setup_.T_world_root;
  for (const int index : base_path_) T = T * T_parent_link(nodes_[index], trolley);
  return T;
}

Pose RobotModel::T_base_camera(const Configuration& q) const {
  CANOPEER_CHECK(q.size() == dof(), "configuration of another arm");
  Pose T[kMaxArmJoints];
  camera_chain_.poses(q, Pose::Identity(), T);
  return T[dof() - 1] * T_last_camera_;
}

void RobotModel::camera_jacobian(const Configuration& q, Pose& T_base_camera,
                                 Jacobian& jacobian) const {
  Pose T[kMaxArmJoints];
  camera_chain_.poses(q, Pose::Identity(), T);
  T_base_camera = T[dof() - 1] * T_last_camera_;
  jacobian.resize(6, dof());
  for (int i = 0; i < dof(); ++i) {
    const Vec3 axis = T[i].linear() * nodes_[arm_nodes_[i]].axis;
    if (arm_joint_type(i) == JointType::kPrismatic) {
      jacobian.col(i) << axis, Vec3::Zero();
    } else {
      jacobian.col(i) << axis.cross(T_base_camera.translation() - T[i].translation()), axis;
    }
  }
}

std::vector<RobotModel::AxisLine> RobotModel::arm_axes(const Configuration& q) const {
  Pose T[kMaxArmJoints];
  camera_chain_.poses(q, Pose::Identity(), T);
  std::vector<AxisLine> axes;
  for (int i = 0; i < dof(); ++i)
    axes.push_back(
        {T[i].translation(), T[i].linear() * nodes_[arm_nodes_[i]].axis, arm_joint_type(i)});
  return axes;
}

std::vector<RobotModel::Hop> RobotModel::arm_hops(int link) const {
  std::vector<Hop> hops;
  for (; nodes_[link].parent >= 0; link = nodes_[link].parent) {
    const Node& node = nodes_[link];
    const Node& parent = nodes_[node.parent];
    if (parent.arm_joints_before == 0) break;
    Hop hop{parent.arm_joints_before - 1, node.T_parent_joint.translation(), parent.axis, 0.0};
    if (node.drive == Drive::kArm && node.type == JointType::kPrismatic)
      hop.slide = std::max(std::abs(limits_.lower[node.arm_joint]),
                           std::abs(limits_.upper[node.arm_joint]));
    // A fixed joint's stretch has no axis of its own; only the first stretch after a joint uses it.
    hops.push_back(hop);
  }
  std::reverse(hops.begin(), hops.end());
  return hops;
}

int RobotModel::link_index(std::string_view name) const {
  const auto it = std::find_if(links_.begin(), links_.end(),
                               [&](const Link& link) { return link.name == name; });
  return it == links_.end() ? -1 : static_cast<int>(it - links_.begin());
}

bool RobotModel::pair_checked(int link_a, int link_b) const {
  return pair_checked_[static_cast<std::size_t>(link_a) * links_.size() +
                       static_cast<std::size_t>(link_b)] != 0;
}

bool RobotModel::joined_by_a_joint(int link_a, int link_b) const {
  // A rigid group is named after the link at its root, which the joint carries.
  const auto parent_group = [&](int group) {
    const int parent = nodes_[group].parent;
    return parent < 0 ? -1 : nodes_[parent].rigid_group;
  };
  const auto hangs_on = [&](int group, int other) {
    do {
      group = parent_group(group);
    } while (group >= 0 && group != other && !group_has_shape_[group]);
    return group == other;
  };
  const int a = nodes_[link_a].rigid_group;
  const int b = nodes_[link_b].rigid_group;
  return hangs_on(a, b) || hangs_on(b, a);
}

Pose RobotModel::T_body_link(int link) const {
  Pose T = Pose::Identity();
  for (; nodes_[link].drive != Drive::kArm; link = nodes_[link].parent) {
    CANOPEER_CHECK(nodes_[link].arm_joints_before > 0, "the link does not move with the arm");
    T = nodes_[link].T_parent_joint * T;
  }
  return T;
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

bool RobotModel::has_home(std::string_view name) const { return setup_.home.count(name) > 0; }

const Configuration& RobotModel::home(std::string_view name) const {
  const auto it = setup_.home.find(name);
  CANOPEER_CHECK(it != setup_.home.end(), "no home state of that name");
  return it->second;
}

const Box& RobotModel::workspace(int side) const {
  CANOPEER_CHECK(side >= 1 && side <= sides(), "no such side");
  return setup_.workspace[side - 1];
}

const Box& RobotModel::sampling_region(int side) const {
  CANOPEER_CHECK(side >= 1 && side <= sides(), "no such side");
  return setup_.sampling_region[side - 1];
}

double joint_distance(const Configuration& a, const Configuration& b) {
  return (a - b).lpNorm<1>();
}

}  // namespace canopeer
