#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::ros {

/// "rgb8", "bgr8", "rgba8", "bgra8" or "mono8".
[[nodiscard]] Expected<void> check_color_encoding(const std::string& encoding);
/// "16UC1" (mm, 0: nothing) or "32FC1" (m, NaN: nothing).
[[nodiscard]] Expected<void> check_depth_encoding(const std::string& encoding);

/// A frame as camera drivers send it; headers are left empty. The encodings were checked.
[[nodiscard]] sensor_msgs::Image color_message(const ColorImage& color,
                                               const std::string& encoding);
[[nodiscard]] sensor_msgs::Image depth_message(const DepthImage& depth,
                                               const std::string& encoding);
/// PixelLabel as mono8.
[[nodiscard]] sensor_msgs::Image label_message(const Image<PixelLabel>& labels);
/// A pinhole without distortion. In ROS whole numbers are centres of pixels.
[[nodiscard]] sensor_msgs::CameraInfo info_message(const CameraIntrinsics& camera);
/// An organised cloud in the camera's optical frame: x, y, z, rgb; NaN where there is nothing.
[[nodiscard]] sensor_msgs::PointCloud2 cloud_message(const RgbdFrame& frame);

}  // namespace canopeer::ros
