#include "canopeer/ros2/out/link_transforms.h"

#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {

std::vector<geometry_msgs::TransformStamped> link_transforms(const RobotModel& robot,
                                                             const Configuration& q,
                                                             const TrolleyState& trolley,
                                                             const std::string& world_frame,
                                                             Stamp stamp) {
  std::vector<Pose> T_world_link;
  robot.link_poses(q, trolley, T_world_link);

  std::vector<geometry_msgs::TransformStamped> frames;
  const auto add = [&](const std::string& parent, const std::string& child, const Pose& T) {
    frames.push_back({header_of(parent, stamp), child, transform_of(T)});
  };
  add(world_frame, robot.links().front().name, T_world_link.front());  // parents come first
  for (const Joint& joint : robot.description().joints) {
    const auto parent = static_cast<std::size_t>(robot.link_index(joint.parent));
    const auto child = static_cast<std::size_t>(robot.link_index(joint.child));
    add(joint.parent, joint.child, T_world_link[parent].inverse() * T_world_link[child]);
  }
  return frames;
}

}  // namespace canopeer::ros
