#include "canopeer/fruit/surface/fruit_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/fruit/surface/voxel_key.h"

namespace canopeer {
namespace {

constexpr int kSide = FruitTsdf::kSide;
constexpr int kCorners = kSide + 1;

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
      if (number >= 0) around_[k] = &tsdf.blocks()[static_cast<std::size_t>(number)];
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

/// Gradient of the distance in the middle of a cell, times four: the difference along each axis.
Vec3 gradient_of(const FourFloats& low, const FourFloats& high) {
  const FourFloats up = high - low;
  const FourFloats both = high + low;
  return {both[1] - both[0] + both[3] - both[2], both[2] - both[0] + both[3] - both[1],
          up[0] + up[1] + up[2] + up[3]};
}

static_assert(sizeof(TsdfLooks) == 2 * sizeof(FourFloats) && kPixelLabels == 4,
              "two loads of four");

void set_looks(const std::array<const TsdfLooks*, 8>& corners, SurfaceVertex& vertex) {
  FourFloats votes = FourFloats{};
  FourFloats color = FourFloats{};
  float color_weight = 1e-6F;
  for (const TsdfLooks* looks : corners) {
    votes += load_lanes<FourFloats>(looks->votes.data());
    const float weight = looks->color_weight;
    color += weight * load_lanes<FourFloats>(looks->color.data());  // the fourth is nothing
    color_weight += weight;
  }
  const float fruit = votes[1] + votes[2] + votes[3];
  vertex.fruit_share = fruit / std::max(1e-6F, fruit + votes[0]);
  int most = 1;
  for (int k = 2; k < kPixelLabels; ++k) most = votes[k] > votes[most] ? k : most;
  vertex.kind = static_cast<PixelLabel>(most);
  const FourFloats mean = color / color_weight + 0.5F;
  const auto channel = [&](int k) {
    return static_cast<std::uint8_t>(std::clamp(mean[k], 0.0F, 255.0F));
  };
  vertex.color = {channel(0), channel(1), channel(2)};
}

/// Sum of where the surface crosses the cell's edges, in voxels from the lowest corner, and how
/// many it crosses: the four edges along each axis at once.
struct Crossings {
  float sum[3] = {};
  int count = 0;
  /// `from`, `to`: distances at the edges' ends. Edges come by where they begin, x fastest.
  void add(int axis, const FourFloats& from, const FourFloats& to) {
    const FourBits crossed = (from < 0.0F) ^ (to < 0.0F);
    const unsigned set = lane_bits(crossed);
    const FourFloats apart = from - to;
    const FourFloats where =
        crossed ? from / (crossed ? apart : all_lanes<FourFloats>(1.0F)) : FourFloats{};
    sum[axis] += where[0] + where[1] + where[2] + where[3];
    // The second and fourth edge lie high along the lower one of the other axes, the third and
    // fourth along the higher one.
    sum[axis == 0 ? 1 : 0] += static_cast<float>(std::popcount(set & 0b1010U));
    sum[axis == 2 ? 1 : 2] += static_cast<float>(std::popcount(set & 0b1100U));
    count += std::popcount(set);
  }
};

std::optional<SurfaceVertex> vertex_of(const Corners& corners, const VoxelIndex& cell,
                                       double voxel_m) {
  const FourFloats low = load_lanes<FourFloats>(corners.distance_m.data());
  const FourFloats high = load_lanes<FourFloats>(corners.distance_m.data() + 4);
  Crossings crossings;
  crossings.add(0, FourFloats{low[0], low[2], high[0], high[2]},
                FourFloats{low[1], low[3], high[1], high[3]});
  crossings.add(1, FourFloats{low[0], low[1], high[0], high[1]},
                FourFloats{low[2], low[3], high[2], high[3]});
  crossings.add(2, low, high);
  if (crossings.count == 0) return std::nullopt;
  const Vec3 gradient = gradient_of(low, high);
  const double length = gradient.norm();
  if (!(length > 1e-9)) return std::nullopt;
  SurfaceVertex vertex;
  vertex.cell = cell;
  vertex.surface.point =
      voxel_centre(cell, voxel_m) +
      voxel_m / crossings.count * Vec3(crossings.sum[0], crossings.sum[1], crossings.sum[2]);
  vertex.surface.normal = gradient / length;
  set_looks(corners.looks, vertex);
  return vertex;
}

}  // namespace

void FruitSurface::extract(const FruitTsdf::Block& block,
                           std::vector<SurfaceVertex>& vertices) const {
  const CellCorners corners(tsdf_, block);
  vertices.clear();
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
}

std::vector<int> FruitSurface::update(int max_blocks) {
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
    const auto n = static_cast<std::size_t>(number);
    extract(tsdf_.blocks()[n], vertices_[n]);
  }
  return remade;
}

bool FruitSurface::relink() {
  if (!tsdf_.relink() || vertices_.size() != tsdf_.blocks().size()) return false;
  for (std::size_t n = 0; n < vertices_.size(); ++n) {
    const VoxelIndex first = tsdf_.blocks()[n].index * kSide;
    for (const SurfaceVertex& vertex : vertices_[n]) {
      const bool in_block = (vertex.cell.array() >= first.array()).all() &&
                            (vertex.cell.array() < first.array() + kSide).all();
      if (!in_block || static_cast<int>(vertex.kind) >= kPixelLabels) return false;
    }
  }
  const auto exists = [&](int n) {
    return n >= 0 && static_cast<std::size_t>(n) < vertices_.size();
  };
  return std::all_of(waiting_.begin(), waiting_.end(), exists);
}

/// FourFloats cells around a voxel edge that the surface crosses make a quad.
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
