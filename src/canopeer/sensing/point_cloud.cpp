#include "canopeer/sensing/point_cloud.h"

#include <cstring>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/check.h"

namespace canopeer {
namespace {

std::string ply_header(const PointCloud& cloud) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment canopeer, metres\n";
  header += "element vertex " + std::to_string(cloud.points.size()) + "\n";
  header += "property float x\nproperty float y\nproperty float z\n";
  if (!cloud.normals.empty()) {
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  }
  if (!cloud.colors.empty()) {
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  return header + "end_header\n";
}

// Little-endian whatever the host is.
void append(std::string& bytes, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<char>((bits >> shift) & 0xFFU));
  }
}

void append(std::string& bytes, const Eigen::Vector3f& v) {
  for (int axis = 0; axis < 3; ++axis) append(bytes, v[axis]);
}

}  // namespace

Expected<void> write_ply(const std::filesystem::path& path, const PointCloud& cloud) {
  const std::size_t count = cloud.points.size();
  CANOPEER_CHECK(cloud.normals.empty() || cloud.normals.size() == count, "one normal per point");
  CANOPEER_CHECK(cloud.colors.empty() || cloud.colors.size() == count, "one colour per point");
  std::string bytes = ply_header(cloud);
  bytes.reserve(bytes.size() + count * 27);
  for (std::size_t i = 0; i < count; ++i) {
    append(bytes, cloud.points[i]);
    if (!cloud.normals.empty()) append(bytes, cloud.normals[i]);
    if (!cloud.colors.empty()) {
      const Rgb& c = cloud.colors[i];
      for (const std::uint8_t channel : {c.r, c.g, c.b}) {
        bytes.push_back(static_cast<char>(channel));
      }
    }
  }
  return write_file(path, bytes);
}

}  // namespace canopeer
