#include "canopeer/ros2/out/frustum_marker.h"

#include <array>

#include "canopeer/ros2/out/message_parts.h"

namespace canopeer::ros {

visualization_msgs::Marker frustum_marker(const CameraIntrinsics& camera,
                                          const Pose& T_world_camera, double depth_m,
                                          const std_msgs::Header& header) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = "frustum";
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.pose = pose_of(T_world_camera);
  marker.scale.x = 0.003;
  marker.color = {0.2F, 0.8F, 0.9F, 0.9F};

  const auto corner = [&](int u, int v) {  // of the image, half a pixel outside of its centres
    return Vec3((u - camera.cx) / camera.fx * depth_m, (v - camera.cy) / camera.fy * depth_m,
                depth_m);
  };
  const std::array<Vec3, 4> corners = {corner(0, 0), corner(camera.width, 0),
                                       corner(camera.width, camera.height),
                                       corner(0, camera.height)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    marker.points.push_back({});
    marker.points.push_back(point_of(corners[i]));
    marker.points.push_back(point_of(corners[i]));
    marker.points.push_back(point_of(corners[(i + 1) % corners.size()]));
  }
  return marker;
}

}  // namespace canopeer::ros
