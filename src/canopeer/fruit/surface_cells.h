#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "canopeer/fruit/fruit_map_options.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// What is known of one cell of fruit surface, as sums over its pixels; world.
struct SurfaceCell {
  VoxelIndex index = VoxelIndex::Zero();
  Vec3 point_sum = Vec3::Zero();
  Vec3 normal_sum = Vec3::Zero();
  std::array<std::int64_t, 3> color_sum{};
  int hits = 0;

  [[nodiscard]] Vec3 point() const { return point_sum / hits; }
  /// Outward unit normal.
  [[nodiscard]] Vec3 normal() const { return normal_sum.normalized(); }
  [[nodiscard]] Rgb color() const;
};

/// Sparse grid of fruit surface. Cells are numbered in the order first seen and never removed.
class SurfaceCells {
 public:
  explicit SurfaceCells(const FruitMapOptions& options);

  /// Adds the frame's usable fruit pixels. Returns the numbers of the cells that changed and have
  /// at least min_hits, ascending, each once.
  std::vector<int> add(const RgbdFrame& frame, const Mask& fruit);

  [[nodiscard]] const std::vector<SurfaceCell>& cells() const { return cells_; }
  [[nodiscard]] bool counts(int cell) const { return cells_[cell].hits >= options_.min_hits; }

 private:
  int cell_at(const Vec3& p_world);

  FruitMapOptions options_;
  std::vector<SurfaceCell> cells_;
  std::unordered_map<std::uint64_t, int> number_of_;  // never iterated
};

}  // namespace canopeer
