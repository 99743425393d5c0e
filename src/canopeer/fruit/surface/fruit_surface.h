#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "canopeer/fruit/surface/fruit_tsdf.h"
#include "canopeer/geometry/superellipsoid.h"

namespace canopeer {

/// A point of the surface, one at most in each cell between eight voxel centres.
struct SurfaceVertex {
  VoxelIndex cell = VoxelIndex::Zero();  ///< of the voxel at its lowest corner
  SurfacePoint surface;                  ///< world, outward normal
  Rgb color;
  float fruit_share = 0.0F;  ///< of the pixels seen near it those taken for fruit, 0 … 1
  PixelLabel kind = PixelLabel::background;  ///< most voted of the fruit classes

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(cell, surface, color, fruit_share, kind);
  }
};

/// Triangles over vertices; normals and colours of all.
struct SurfaceMesh {
  std::vector<SurfaceVertex> vertices;
  std::vector<int> fruit;  ///< id of the fruit a vertex belongs to, −1: none; as long as vertices
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// The zero level of a FruitTsdf, kept up to date block by block (surface nets, Gibson 1998). A
/// vertex is the mean of where the surface crosses its cell's edges. Cells with a corner never seen
/// have none, so nothing is made up behind leaves.
class FruitSurface {
 public:
  explicit FruitSurface(const TsdfOptions& options) : tsdf_(options) {}

  void add(const RgbdFrame& frame, const Image<std::uint8_t>& classes) {
    tsdf_.add(frame, classes);
    vertices_.resize(tsdf_.blocks().size());
  }

  /// Makes the vertices of changed blocks: of all that had none, and of at most `max_blocks` others
  /// in the order they changed. The rest waits. Returns the blocks' numbers, ascending.
  std::vector<int> update(int max_blocks = std::numeric_limits<int>::max());

  [[nodiscard]] const FruitTsdf& tsdf() const { return tsdf_; }
  [[nodiscard]] const std::vector<SurfaceVertex>& vertices(int block) const {
    return vertices_[static_cast<std::size_t>(block)];
  }
  /// All of it as of the last update(), `fruit` all −1.
  [[nodiscard]] SurfaceMesh mesh() const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(tsdf_, vertices_, waiting_);
  }
  /// After reading: see FruitTsdf::relink().
  [[nodiscard]] bool relink();

 private:
  void extract(const FruitTsdf::Block& block, std::vector<SurfaceVertex>& vertices) const;

  FruitTsdf tsdf_;
  std::vector<std::vector<SurfaceVertex>> vertices_;  // by block number
  std::vector<int> waiting_;                          // blocks that have changed
};

}  // namespace canopeer
