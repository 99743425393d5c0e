#include "canopeer/ros2/robot/robot_frames.h"

namespace canopeer::ros {
namespace {

geometry_msgs::TransformStamped transform_of(const Pose& T, const std::string& parent,
                                             const std::string& child,
                                             const builtin_interfaces::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  const Vec3 p = T.translation();
  const Eigen::Quaterniond r(T.linear());
  message.transform.translation = {p.x(), p.y(), p.z()};
  message.transform.rotation = {r.x(), r.y(), r.z(), r.w()};
  return message;
}

}  // namespace

RobotFrames::RobotFrames(const RobotModel& robot)
    : robot_(robot), root_(robot.links().front().name) {
  for (const Joint& joint : robot.description().joints) {
    const Frame frame{robot.link_index(joint.parent), robot.link_index(joint.child)};
    (joint.type == JointType::kFixed ? fixed_ : moving_).push_back(frame);
  }
}

tf2_msgs::TFMessage RobotFrames::fixed(const builtin_interfaces::Time& stamp) const {
  std::vector<Pose> T_world;
  robot_.link_poses(Configuration::Zero(robot_.dof()), {}, T_world);
  tf2_msgs::TFMessage message;
  if (root_ != "world") {
    message.transforms.push_back(transform_of(robot_.setup().T_world_root, "world", root_, stamp));
  }
  for (const Frame& f : fixed_) {
    message.transforms.push_back(transform_of(T_world[f.parent].inverse() * T_world[f.link],
                                              robot_.links()[f.parent].name,
                                              robot_.links()[f.link].name, stamp));
  }
  return message;
}

tf2_msgs::TFMessage RobotFrames::moving(const Configuration& q, const TrolleyState& trolley,
                                        const builtin_interfaces::Time& stamp) const {
  std::vector<Pose> T_world;
  robot_.link_poses(q, trolley, T_world);
  tf2_msgs::TFMessage message;
  for (const Frame& f : moving_) {
    message.transforms.push_back(transform_of(T_world[f.parent].inverse() * T_world[f.link],
                                              robot_.links()[f.parent].name,
                                              robot_.links()[f.link].name, stamp));
  }
  return message;
}

}  // namespace canopeer::ros
