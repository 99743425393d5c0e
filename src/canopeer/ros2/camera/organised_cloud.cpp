#include "canopeer/ros2/camera/organised_cloud.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <string>
#include <vector>

#include "canopeer/base/byte_order.h"
#include "canopeer/ros2/camera/raw_image.h"

namespace canopeer::ros {
namespace {

using sensor_msgs::PointField;

/// What lies farther is damage: no camera measures it.
constexpr double kFarthest_m = 1e4;

std::size_t octets_of(std::uint8_t datatype) {
  switch (datatype) {
    case PointField::INT8:
    case PointField::UINT8:
      return 1;
    case PointField::INT16:
    case PointField::UINT16:
      return 2;
    case PointField::FLOAT64:
      return 8;
    default:
      return 4;
  }
}

/// A field that lies within a point.
const PointField* field_named(const sensor_msgs::PointCloud2& cloud, const char* name) {
  for (const PointField& field : cloud.fields) {
    const std::uint64_t end = std::uint64_t{field.offset} + octets_of(field.datatype);
    if (field.name == name && end <= cloud.point_step) return &field;
  }
  return nullptr;
}

Expected<const PointField*> coordinate_field(const sensor_msgs::PointCloud2& cloud,
                                             const char* name) {
  const PointField* const field = field_named(cloud, name);
  if (field == nullptr ||
      (field->datatype != PointField::FLOAT32 && field->datatype != PointField::FLOAT64)) {
    return fail("the cloud has no field '" + std::string(name) + "' of 32 or 64 bit reals");
  }
  return field;
}

Expected<void> check_cloud(const sensor_msgs::PointCloud2& cloud) {
  if (cloud.height <= 1) {
    return fail(
        "the cloud is not organised (its height is 1): have the driver publish it as an image of "
        "points (RealSense: pointcloud.ordered_pc, allow_no_texture_points)");
  }
  if (auto size = check_image_size(cloud.width, cloud.height); !size) return size;
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.point_step == 0 || cloud.row_step < row ||
      cloud.data.size() < std::uint64_t{cloud.row_step} * (cloud.height - 1) + row) {
    return fail("the cloud has fewer octets than its size says: damaged");
  }
  return {};
}

/// How pixels follow from one coordinate: pixel = focal · slope + centre, by least squares.
class AxisFit {
 public:
  void add(double slope, double pixel) {
    const Eigen::Vector2d row(slope, 1.0);
    normal_ += row * row.transpose();
    right_ += row * pixel;
    squares_ += pixel * pixel;
    ++count_;
  }
  struct Line {
    double focal = 0.0;
    double center = 0.0;
    double rms_px = 0.0;
  };
  [[nodiscard]] std::optional<Line> line() const {
    constexpr int kMinPoints = 100;
    constexpr double kMinSpread = 1e-3;
    if (count_ < kMinPoints) return std::nullopt;
    const double mean = normal_(0, 1) / count_;
    if (normal_(0, 0) / count_ - mean * mean < kMinSpread * kMinSpread) return std::nullopt;
    const Eigen::Vector2d fit = normal_.ldlt().solve(right_);
    const double left = squares_ - fit.dot(right_);
    return Line{fit.x(), fit.y(), std::sqrt(std::max(0.0, left / count_))};
  }

 private:
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right_ = Eigen::Vector2d::Zero();
  double squares_ = 0.0;
  int count_ = 0;
};

double real_at(const char* point, const PointField& field, ByteOrder order) {
  const char* const bytes = point + field.offset;
  return field.datatype == PointField::FLOAT64
             ? load_number<double>(bytes, order)
             : static_cast<double>(load_number<float>(bytes, order));
}

/// Drivers pack red, green and blue into the lower 24 bits, whatever the field's type says.
Rgb packed_color(const char* point, const PointField& field, ByteOrder order) {
  const auto bits = load_number<std::uint32_t>(point + field.offset, order);
  return {static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 8),
          static_cast<std::uint8_t>(bits)};
}

}  // namespace

Expected<CloudImages> images_of(const sensor_msgs::PointCloud2& cloud) {
  if (auto sound = check_cloud(cloud); !sound) return tl::unexpected(sound.error());
  const auto x_field = coordinate_field(cloud, "x");
  const auto y_field = coordinate_field(cloud, "y");
  const auto z_field = coordinate_field(cloud, "z");
  for (const auto* field : {&x_field, &y_field, &z_field}) {
    if (!*field) return tl::unexpected(field->error());
  }
  const PointField* color_field = field_named(cloud, "rgb");
  if (color_field == nullptr) color_field = field_named(cloud, "rgba");
  if (color_field != nullptr && octets_of(color_field->datatype) != 4) color_field = nullptr;

  const ByteOrder order = cloud.is_bigendian ? ByteOrder::big : ByteOrder::little;
  const int width = static_cast<int>(cloud.width), height = static_cast<int>(cloud.height);
  CloudImages images;
  images.depth = DepthImage(width, height, 0.0F);
  if (color_field != nullptr) images.color = ColorImage(width, height);
  AxisFit across, down;
  for (int v = 0; v < height; ++v) {
    const char* const row = reinterpret_cast<const char*>(cloud.data.data()) +
                            static_cast<std::size_t>(v) * cloud.row_step;
    for (int u = 0; u < width; ++u) {
      const char* const point = row + static_cast<std::size_t>(u) * cloud.point_step;
      if (color_field != nullptr) images.color.at(u, v) = packed_color(point, *color_field, order);
      const double z = real_at(point, **z_field, order);
      const double x = real_at(point, **x_field, order), y = real_at(point, **y_field, order);
      if (!(z > 0.0 && z < kFarthest_m && std::isfinite(x + y))) continue;
      images.depth.at(u, v) = static_cast<float>(z);
      across.add(x / z, u + 0.5);
      down.add(y / z, v + 0.5);
    }
  }
  const auto lines = std::pair(across.line(), down.line());
  if (!lines.first || !lines.second) return images;
  constexpr double kMostMiss_px = 1.0;
  const auto& [h, v] = lines;
  if (!(h->focal > 1.0 && v->focal > 1.0 && h->rms_px < kMostMiss_px && v->rms_px < kMostMiss_px)) {
    return fail(
        "the cloud's points are not those of a pinhole camera in its optical frame (z forward, y "
        "down): use the camera's own cloud, not one that was moved into another frame");
  }
  CameraIntrinsics k;
  k.width = width;
  k.height = height;
  k.fx = h->focal;
  k.fy = v->focal;
  k.cx = h->center;
  k.cy = v->center;
  images.intrinsics = k;
  return images;
}

}  // namespace canopeer::ros
