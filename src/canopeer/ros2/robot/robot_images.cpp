#include "canopeer/ros2/robot/robot_images.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace canopeer::ros {
namespace {

using sensor_msgs::Image;

int channels_of(const std::string& encoding) {
  if (encoding == "mono8") return 1;
  if (encoding == "rgb8" || encoding == "bgr8") return 3;
  return encoding == "rgba8" || encoding == "bgra8" ? 4 : 0;
}

Image empty_image(int width, int height, const std::string& encoding, int octets_a_pixel) {
  Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.encoding = encoding;
  image.step = image.width * static_cast<std::uint32_t>(octets_a_pixel);
  image.data.resize(std::size_t{image.step} * image.height);
  return image;
}

float nothing() { return std::numeric_limits<float>::quiet_NaN(); }

}  // namespace

Expected<void> check_color_encoding(const std::string& encoding) {
  if (channels_of(encoding) > 0) return {};
  return fail("colour encoding '" + encoding +
              "' is not known; expected rgb8, bgr8, rgba8, bgra8 or mono8");
}

Expected<void> check_depth_encoding(const std::string& encoding) {
  if (encoding == "16UC1" || encoding == "32FC1") return {};
  return fail("depth encoding '" + encoding + "' is not known; expected 16UC1 or 32FC1");
}

Image color_message(const ColorImage& color, const std::string& encoding) {
  const int channels = channels_of(encoding);
  Image image = empty_image(color.width(), color.height(), encoding, channels);
  const bool blue_first = encoding.starts_with("bgr");
  std::uint8_t* to = image.data.data();
  for (const Rgb& pixel : color.pixels()) {
    if (channels == 1) {
      *to = static_cast<std::uint8_t>((299 * pixel.r + 587 * pixel.g + 114 * pixel.b) / 1000);
    } else {
      to[0] = blue_first ? pixel.b : pixel.r;
      to[1] = pixel.g;
      to[2] = blue_first ? pixel.r : pixel.b;
      if (channels == 4) to[3] = 255;
    }
    to += channels;
  }
  return image;
}

Image depth_message(const DepthImage& depth, const std::string& encoding) {
  const bool metres = encoding == "32FC1";
  Image image = empty_image(depth.width(), depth.height(), encoding, metres ? 4 : 2);
  std::uint8_t* to = image.data.data();
  for (const float z : depth.pixels()) {
    const bool seen = z > 0.0F;
    if (metres) {
      const float value = seen ? z : nothing();
      std::memcpy(to, &value, 4);
      to += 4;
    } else {
      const float mm = seen ? std::min(std::round(z * 1000.0F), 65534.0F) : 0.0F;
      const auto value = static_cast<std::uint16_t>(mm);
      std::memcpy(to, &value, 2);
      to += 2;
    }
  }
  return image;
}

Image label_message(const canopeer::Image<PixelLabel>& labels) {
  Image image = empty_image(labels.width(), labels.height(), "mono8", 1);
  std::memcpy(image.data.data(), labels.pixels().data(), image.data.size());
  return image;
}

sensor_msgs::CameraInfo info_message(const CameraIntrinsics& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.d.assign(5, 0.0);
  const double cx = camera.cx - 0.5;
  const double cy = camera.cy - 0.5;
  info.k = {camera.fx, 0, cx, 0, camera.fy, cy, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {camera.fx, 0, cx, 0, 0, camera.fy, cy, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::PointCloud2 cloud_message(const RgbdFrame& frame) {
  sensor_msgs::PointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(frame.depth.width());
  cloud.height = static_cast<std::uint32_t>(frame.depth.height());
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z", "rgb"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    offset += 4;
  }
  cloud.point_step = 16;
  cloud.row_step = 16 * cloud.width;
  cloud.data.resize(std::size_t{cloud.row_step} * cloud.height);
  std::uint8_t* to = cloud.data.data();
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u, to += 16) {
      const float z = frame.depth.at(u, v);
      const bool seen = z > 0.0F;
      const Eigen::Vector3f p = (static_cast<double>(z) * frame.intrinsics.ray(u, v)).cast<float>();
      const float xyz[3] = {seen ? p.x() : nothing(), seen ? p.y() : nothing(),
                            seen ? p.z() : nothing()};
      const Rgb& c = frame.color.at(u, v);
      const std::uint32_t rgb = (std::uint32_t{c.r} << 16) | (std::uint32_t{c.g} << 8) | c.b;
      std::memcpy(to, xyz, 12);
      std::memcpy(to + 12, &rgb, 4);
    }
  }
  return cloud;
}

}  // namespace canopeer::ros
