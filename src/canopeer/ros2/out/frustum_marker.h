#pragma once

#include "canopeer/cdr/messages/visualization_msgs.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer::ros {

/// What the camera saw: the pyramid up to `depth_m` before it. `header.frame_id` is the world.
[[nodiscard]] visualization_msgs::Marker frustum_marker(const CameraIntrinsics& camera,
                                                        const Pose& T_world_camera, double depth_m,
                                                        const std_msgs::Header& header);

}  // namespace canopeer::ros
