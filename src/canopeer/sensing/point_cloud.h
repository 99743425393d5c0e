#pragma once

#include <filesystem>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Points in one frame; `colors` and `normals` are empty or as long as `points`.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Rgb> colors;
};

/// Binary little-endian PLY with x y z, and nx ny nz / red green blue when present.
[[nodiscard]] Expected<void> write_ply(const std::filesystem::path& path, const PointCloud& cloud);

}  // namespace canopeer
