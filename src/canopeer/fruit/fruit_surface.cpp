#include "canopeer/fruit/fruit_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "canopeer/fruit/voxel_key.h"

namespace canopeer {
namespace {

constexpr int kSide = FruitTsdf::kSide;
constexpr int kCorners = kSide + 1;

/// Corners (x fastest) where the four edges of a cell along x, y, z begin.
constexpr int kEdgesFrom[3][4] = {{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3}};

/// A cell's corners, x fastest.
struct Corners {
  std::array<float, 8> distance_m{};
  std::array<const TsdfLooks*, 8> looks{};
};

/// A block and those above it along the axes: the cells' corners lie in them. Which cells the
/// surface goes through is told from the bits of whole rows.
class CellCorners {
 public:
  CellCorners(const FruitTsdf& tsdf, const FruitTsdf::Block& block) {
    for (int k = 0; k < 8; ++k) {
      const int number = block.around[13 + (k & 1) + 3 * ((k >> 1) & 1) + 9 * (k >> 2)];
      if (number >= 0) around_[k] = tsdf.blocks()[static_cast<std::size_t>(number)].get();
    }
    for (int z = 0; z < kCorners; ++z) {
      for (int y = 0; y < kCorners; ++y) set_row(y, z);
    }
  }

  /// Bit x: the surface goes through the cell and all its corners were seen.
  [[nodiscard]] unsigned crossed(int y, int z) const {
    const auto in_cells = [](unsigned any) { return any | any >> 1U; };
    const unsigned seen = seen_[z][y] & seen_[z][y + 1] & seen_[z + 1][y] & seen_[z + 1][y + 1];
    const unsigned inside =
        inside_[z][y] | inside_[z][y + 1] | inside_[z + 1][y] | inside_[z + 1][y + 1];
    const unsigned outside =
        ~(inside_[z][y] & inside_[z][y + 1] & inside_[z + 1][y] & inside_[z + 1][y + 1]);
    return seen & seen >> 1U & in_cells(inside) & in_cells(outside) & 0xFFU;
  }

  /// Of a cell all of whose corners were seen.
  [[nodiscard]] Corners of_cell(int x, int y, int z) const {
    Corners corners;
    for (int k = 0; k < 8; ++k) {
      const int cx = x + (k & 1);
      const int cy = y + ((k >> 1) & 1);
      const int cz = z + (k >> 2);
      const FruitTsdf::Block& block = *around_[(cx >> 3) + 2 * (cy >> 3) + 4 * (cz >> 3)];
      const std::size_t voxel = FruitTsdf::offset(cx & 7, cy & 7, cz & 7);
      corners.distance_m[k] = block.distance_m[voxel];
      corners.looks[k] = &block.looks[voxel];
    }
    return corners;
  }

 private:
  /// Nine corners: eight of the block the row lies in, the first of the next along x.
  void set_row(int y, int z) {
    const int here = 2 * (y >> 3) + 4 * (z >> 3);
    const std::size_t row = static_cast<std::size_t>((y & 7) + kSide * (z & 7));
    unsigned seen = 0;
    unsigned inside = 0;
    if (const FruitTsdf::Block* block = around_[here]) {
      seen = block->seen[row];
      inside = block->inside[row];
    }
    if (const FruitTsdf::Block* next = around_[here + 1]) {
      seen |= (next->seen[row] & 1U) << 8U;
      inside |= (next->inside[row] & 1U) << 8U;
    }
    seen_[z][y] = seen;
    inside_[z][y] = inside;
  }

  const FruitTsdf::Block* around_[8] = {};
  unsigned seen_[kCorners][kCorners];
  unsigned inside_[kCorners][kCorners];
};

/// Gradient of the distance in the middle of a cell: the mean difference along each axis.
Vec3 gradient_of(const std::array<float, 8>& distance_m) {
  Vec3 g = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      g[axis] += ((k >> axis) & 1) != 0 ? distance_m[k] : -distance_m[k];
    }
  }
  return g;
}

void set_looks(const std::array<const TsdfLooks*, 8>& corners, SurfaceVertex& vertex) {
  std::array<float, kPixelLabels> votes{};
  std::array<float, 3> color{};
  float color_weight = 1e-6F;
  for (const TsdfLooks* looks : corners) {
    for (int k = 0; k < kPixelLabels; ++k) votes[k] += looks->votes[k];
    for (int k = 0; k < 3; ++k) color[k] += looks->color_weight * looks->color[k];
    color_weight += looks->color_weight;
  }
  const float fruit = votes[1] + votes[2] + votes[3];
  vertex.fruit_share = fruit / std::max(1e-6F, fruit + votes[0]);
  vertex.looks = (fruit + votes[0]) / static_cast<float>(corners.size());
  const auto most = std::max_element(votes.begin() + 1, votes.end());
  vertex.kind = static_cast<PixelLabel>(most - votes.begin());
  const auto channel = [&](int k) {
    return static_cast<std::uint8_t>(std::clamp(color[k] / color_weight + 0.5F, 0.0F, 255.0F));
  };
  vertex.color = {channel(0), channel(1), channel(2)};
}

std::optional<SurfaceVertex> vertex_of(const Corners& corners, const VoxelIndex& cell,
                                       double voxel_m) {
  float sum[3] = {};
  int crossings = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int a : kEdgesFrom[axis]) {
      const float da = corners.distance_m[a];
      const float db = corners.distance_m[a | 1 << axis];
      if ((da < 0.0F) == (db < 0.0F)) continue;
      for (int k = 0; k < 3; ++k) {
        sum[k] += k == axis ? da / (da - db) : static_cast<float>((a >> k) & 1);
      }
      ++crossings;
    }
  }
  if (crossings == 0) return std::nullopt;
  const Vec3 gradient = gradient_of(corners.distance_m);
  if (!(gradient.norm() > 1e-9)) return std::nullopt;
  SurfaceVertex vertex;
  vertex.cell = cell;
  vertex.surface.point =
      voxel_centre(cell, voxel_m) + voxel_m / crossings * Vec3(sum[0], sum[1], sum[2]);
  vertex.surface.normal = gradient.normalized();
  set_looks(corners.looks, vertex);
  return vertex;
}

}  // namespace

std::vector<SurfaceVertex> FruitSurface::extract(const FruitTsdf::Block& block) const {
  const CellCorners corners(tsdf_, block);
  std::vector<SurfaceVertex> vertices;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (unsigned bits = corners.crossed(y, z); bits != 0; bits &= bits - 1) {
        const int x = std::countr_zero(bits);
        const VoxelIndex cell = block.index * kSide + VoxelIndex(x, y, z);
        auto vertex = vertex_of(corners.of_cell(x, y, z), cell, tsdf_.options().voxel_m);
        if (vertex) vertices.push_back(*vertex);
      }
    }
  }
  return vertices;
}

std::vector<int> FruitSurface::update(int max_blocks) {
  vertices_.resize(tsdf_.blocks().size());
  std::vector<char> waits(vertices_.size(), 0);
  for (const int number : waiting_) waits[static_cast<std::size_t>(number)] = 1;
  for (const int number : tsdf_.take_changed()) {
    if (waits[static_cast<std::size_t>(number)] == 0) waiting_.push_back(number);
  }
  const auto is_new = [&](int number) {
    return vertices_[static_cast<std::size_t>(number)].empty();
  };
  const auto old = std::stable_partition(waiting_.begin(), waiting_.end(), is_new);
  const auto count =
      old - waiting_.begin() + std::min<std::ptrdiff_t>(waiting_.end() - old, max_blocks);
  std::vector<int> remade(waiting_.begin(), waiting_.begin() + count);
  waiting_.erase(waiting_.begin(), waiting_.begin() + count);
  std::sort(remade.begin(), remade.end());
  for (const int number : remade) {
    vertices_[static_cast<std::size_t>(number)] =
        extract(*tsdf_.blocks()[static_cast<std::size_t>(number)]);
  }
  return remade;
}

/// Four cells around a voxel edge that the surface crosses make a quad.
SurfaceMesh FruitSurface::mesh() const {
  SurfaceMesh mesh;
  std::unordered_map<std::uint64_t, std::uint32_t> at_cell;  // never iterated
  for (const auto& block : vertices_) {
    for (const SurfaceVertex& vertex : block) {
      at_cell.emplace(voxel_key(vertex.cell), static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back(vertex);
    }
  }
  mesh.fruit.assign(mesh.vertices.size(), -1);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const VoxelIndex cell = mesh.vertices[i].cell;
    for (int axis = 0; axis < 3; ++axis) {
      const VoxelIndex up = VoxelIndex::Unit(axis);
      const VoxelIndex b = VoxelIndex::Unit((axis + 1) % 3);
      const VoxelIndex c = VoxelIndex::Unit((axis + 2) % 3);
      const auto low = tsdf_.distance_at(cell);
      const auto high = tsdf_.distance_at(cell + up);
      if (!low || !high || (*low < 0.0F) == (*high < 0.0F)) continue;
      std::array<std::uint32_t, 4> quad{};
      bool whole = true;
      const VoxelIndex cells[4] = {cell, cell - b, cell - b - c, cell - c};
      for (int k = 0; k < 4 && whole; ++k) {
        const auto found = at_cell.find(voxel_key(cells[k]));
        whole = found != at_cell.end();
        if (whole) quad[static_cast<std::size_t>(k)] = found->second;
      }
      if (!whole) continue;
      // Outside is where distances are positive; counter-clockwise seen from there.
      if (*low > 0.0F) std::swap(quad[1], quad[3]);
      mesh.triangles.push_back({quad[0], quad[1], quad[2]});
      mesh.triangles.push_back({quad[0], quad[2], quad[3]});
    }
  }
  return mesh;
}

}  // namespace canopeer
