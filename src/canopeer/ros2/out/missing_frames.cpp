#include "canopeer/ros2/out/missing_frames.h"

#include <algorithm>

#include "canopeer/ros2/out/link_transforms.h"
#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {
namespace {

Pose pose_from(const geometry_msgs::Transform& transform) {
  const auto& [t, r] = transform;
  Pose T = Pose::Identity();
  T.translation() = Vec3(t.x, t.y, t.z);
  T.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix();
  return T;
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> missing_frames(const RobotModel& robot,
                                                            const RobotPlace& place,
                                                            const std::string& map_frame,
                                                            const OthersFrames::Frames& others,
                                                            Stamp stamp) {
  auto frames = link_transforms(robot, place.q, place.trolley, map_frame, stamp);
  std::erase_if(frames, [&](const auto& frame) { return others.contains(frame.child_frame_id); });

  OthersFrames::Frames all = others;
  for (const auto& frame : frames) {
    all[frame.child_frame_id] = {frame.header.frame_id, pose_from(frame.transform)};
  }
  // Up from the arm's base to where nobody says more.
  std::string top = robot.setup().base_link;
  Pose T_top_base = Pose::Identity();
  for (std::size_t steps = 0; steps <= all.size(); ++steps) {
    const auto at = all.find(top);
    if (at == all.end()) break;
    T_top_base = at->second.T_parent_child * T_top_base;
    top = at->second.parent;
  }
  if (top != map_frame && !all.contains(top)) {
    const Pose T_map_top = robot.T_world_base(place.trolley) * T_top_base.inverse();
    frames.push_back({header_of(map_frame, stamp), top, transform_of(T_map_top)});
  }
  return frames;
}

}  // namespace canopeer::ros
