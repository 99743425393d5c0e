#include "canopeer/robot/robot_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/base/check.h"
#include "canopeer/base/exact_text.h"
#include "canopeer/robot/kinematics/joint_drives.h"

namespace canopeer {
namespace {

const Joint* find_joint(const RobotDescription& robot, const std::string& name) {
  const auto it = std::find_if(robot.joints.begin(), robot.joints.end(),
                               [&](const Joint& joint) { return joint.name == name; });
  return it == robot.joints.end() ? nullptr : &*it;
}

Joint fixed_axis() {
  Joint joint;
  joint.lower = joint.upper = 0.0;
  return joint;
}

/// The joints of the setup must exist and be of types that can be driven.
Expected<void> check_names(const RobotDescription& robot, const RobotSetup& setup) {
  const auto check = [&](const std::string& name, bool arm) -> Expected<void> {
    const char* const what = arm ? "arm joint" : "trolley axis";
    const Joint* const joint = find_joint(robot, name);
    if (joint == nullptr) return fail("no joint is called '" + name + "' (" + what + ")");
    if (joint->type != JointType::kPrismatic && !(arm && joint->type == JointType::kRevolute))
      return fail("joint '" + name + "' must be " + (arm ? "revolute or prismatic" : "prismatic") +
                  " (" + what + ")");
    return {};
  };
  for (auto it = setup.arm_joints.begin(); it != setup.arm_joints.end(); ++it) {
    if (auto ok = check(*it, true); !ok) return ok;
    if (std::find(setup.arm_joints.begin(), it, *it) != it)
      return fail("joint '" + *it + "' is listed twice");
  }
  for (const std::string& axis : {setup.travel_joint, setup.lift_joint}) {
    if (axis.empty()) continue;
    if (auto ok = check(axis, false); !ok) return ok;
  }
  return {};
}

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : "; ") + part;
  return all;
}

}  // namespace

Expected<RobotModel> RobotModel::make(RobotDescription description, RobotSetup setup) {
  RobotModel model;
  model.description_ = std::move(description);
  model.setup_ = std::move(setup);
  if (auto ordered = model.order_links(); !ordered) return fail(ordered.error().message);
  if (auto assigned = model.assign_roles(); !assigned) return fail(assigned.error().message);
  if (auto paths = model.find_paths(); !paths) return fail(paths.error().message);
  if (auto checked = model.check_setup(); !checked) return fail(checked.error().message);
  if (auto compiled = model.compile_chains(); !compiled) return fail(compiled.error().message);
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
  const int dof = static_cast<int>(setup_.arm_joints.size());
  if (dof < 1 || dof > kMaxArmJoints)
    return fail("arm_joints: expected at least 1 and at most " + std::to_string(kMaxArmJoints) +
                " joints, found " + std::to_string(dof));
  if (auto named = check_names(description_, setup_); !named) return named;
  JointDrives drives = find_drives(description_, setup_);
  limit_drivers(description_, drives);
  if (!drives.problems.empty()) return fail(joined(drives.problems));
  for (const std::string& notice : drives.notices) description_.notices.push_back(notice);

  limits_ = {Configuration(dof), Configuration(dof), Configuration(dof), Configuration(dof)};
  arm_nodes_.assign(static_cast<std::size_t>(dof), -1);
  travel_axis_ = lift_axis_ = fixed_axis();
  for (std::size_t k = 0; k < description_.joints.size(); ++k) {
    const Joint& joint = description_.joints[k];
    const JointDrive& drive = drives.of[k];
    const int index = link_index(joint.child);
    Node& node = nodes_[static_cast<std::size_t>(index)];
    if (drive.kind == JointDrive::Kind::kStands) {
      node.T_parent_joint = joint_pose(joint, drive.offset);
      if (joint.type == JointType::kPlanar || joint.type == JointType::kFloating)
        node.T_parent_joint = node.T_parent_joint * drive.pose;
      node.type = JointType::kFixed;
      continue;
    }
    node.follows = drive.follows;
    node.multiplier = drive.multiplier;
    node.offset = drive.offset;
    if (drive.kind != JointDrive::Kind::kArm) {
      const bool travels = drive.kind == JointDrive::Kind::kTravel;
      node.drive = travels ? Drive::kTravel : Drive::kLift;
      if (!drive.follows) (travels ? travel_axis_ : lift_axis_) = joint;
      continue;
    }
    node.drive = Drive::kArm;
    node.arm_joint = drive.arm_joint;
    has_followers_ = has_followers_ || drive.follows;
    if (drive.follows) continue;
    const int i = drive.arm_joint;
    arm_nodes_[static_cast<std::size_t>(i)] = index;
    limits_.lower[i] = joint.lower;
    limits_.upper[i] = joint.upper;
    limits_.velocity[i] = joint.velocity_limit;
    limits_.acceleration[i] = joint.acceleration_limit;
  }
  endless_ = EndlessJoints(limits_);
  span_ = limits_;
  for (int i = 0; i < dof; ++i) {
    if (!endless_[i]) continue;
    span_.lower[i] = -std::numbers::pi;
    span_.upper[i] = std::numbers::pi;
  }
  return {};
}

/// What moves with which joints, and the ways from the root to the base and on to the camera.
Expected<void> RobotModel::find_paths() {
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const Node& parent = nodes_[node.parent];
    node.own_joints_before = parent.own_joints_before;
    node.arm_joints_before = parent.arm_joints_before;
    if (node.drive == Drive::kArm) {
      if (!node.follows) {
        if (node.arm_joint != parent.own_joints_before)
          return fail("arm joints must form one chain, listed from base to tool; '" +
                      setup_.arm_joints[node.arm_joint] + "' is out of order");
        ++node.own_joints_before;
      }
      node.arm_joints_before = std::max(parent.arm_joints_before, node.arm_joint + 1);
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
  if (nodes_[base].arm_joints_before != 0 || nodes_[camera].own_joints_before != dof())
    return fail("all arm joints must lie between base_link '" + setup_.base_link +
                "' and camera_frame '" + setup_.camera_frame + "'");
  for (const int index : camera_path_) {
    if (nodes_[index].drive == Drive::kTravel || nodes_[index].drive == Drive::kLift)
      return fail("a trolley axis lies between base_link and camera_frame");
  }
  return {};
}

Expected<void> RobotModel::check_setup() {
  std::string wrong;
  for (auto& [name, q] : setup_.home) {
    if (q.size() != dof())
      return fail("home state '" + name + "' needs " + std::to_string(dof()) + " values");
    for (int i = 0; i < dof(); ++i) {
      const double within = std::clamp(q[i], limits_.lower[i], limits_.upper[i]);
      if (std::abs(q[i] - within) <= kLimitTolerance && std::abs(q[i]) <= kLargestPosition) {
        q[i] = within;
        continue;
      }
      wrong += (wrong.empty() ? "" : "; ") +
               ("home state '" + name + "': joint '" + setup_.arm_joints[i]) + "' at " +
               exact_text(q[i]) + " is outside its limits " + exact_text(limits_.lower[i]) +
               " ... " + exact_text(limits_.upper[i]);
    }
  }
  if (!wrong.empty()) return fail(wrong);
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

void RobotModel::slow_down(double speed) {
  for (JointLimits* const limits : {&limits_, &span_}) {
    limits->velocity *= speed;
    limits->acceleration *= speed * speed;
  }
}

bool RobotModel::within_limits(const Configuration& q) const {
  return (q.array() >= limits_.lower.array() - kLimitTolerance).all() &&
         (q.array() <= limits_.upper.array() + kLimitTolerance).all();
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

bool RobotModel::carried_by(int link_a, int link_b) const {
  for (; link_a >= 0; link_a = nodes_[link_a].parent) {
    if (rigidly_joined(link_a, link_b)) return true;
  }
  return false;
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
  CANOPEER_CHECK(body_of(link) >= 0, "the link does not move with the arm");
  return T_carrier_link_[static_cast<std::size_t>(link)];
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
