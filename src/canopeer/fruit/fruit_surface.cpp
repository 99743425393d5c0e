#include "canopeer/fruit/fruit_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "canopeer/fruit/voxel_key.h"

namespace canopeer {
namespace {

constexpr int kSide = FruitTsdf::kSide;
constexpr int kCorners = kSide + 1;
constexpr float kMinWeight = 0.1F;  // about one frame from 1.5 m

/// The eight corners of a cell, x fastest, and its twelve edges between them.
constexpr int kEdges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                               {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

constexpr std::uint8_t kUnseen = 4;
constexpr std::uint8_t kOutside = 1;
constexpr std::uint8_t kInside = 2;

/// The voxels of a block and the first layer beyond its upper sides, and on which side of the
/// surface each is: most cells are told from that alone.
struct Corners {
  std::array<const TsdfVoxel*, kCorners * kCorners * kCorners> voxel;
  std::array<std::uint8_t, kCorners * kCorners * kCorners> side;

  static std::size_t index(int x, int y, int z) {
    return static_cast<std::size_t>(x + kCorners * (y + kCorners * z));
  }
  /// Whether the surface goes through the cell and all its corners were seen.
  [[nodiscard]] bool crossed(int x, int y, int z) const {
    const std::uint8_t* s = side.data() + index(x, y, z);
    constexpr int kUp = kCorners * kCorners;
    return (s[0] | s[1] | s[kCorners] | s[kCorners + 1] | s[kUp] | s[kUp + 1] | s[kUp + kCorners] |
            s[kUp + kCorners + 1]) == (kOutside | kInside);
  }
};

Corners corners_of(const FruitTsdf& tsdf, const FruitTsdf::Block& block) {
  Corners corners;
  corners.side.fill(kUnseen);
  const FruitTsdf::Block* around[8];
  for (int k = 0; k < 8; ++k) {
    const int number = tsdf.block_at(block.index + VoxelIndex(k & 1, (k >> 1) & 1, k >> 2));
    around[k] = number < 0 ? nullptr : tsdf.blocks()[static_cast<std::size_t>(number)].get();
  }
  for (int z = 0; z < kCorners; ++z) {
    for (int y = 0; y < kCorners; ++y) {
      for (int x = 0; x < kCorners; ++x) {
        const int k = (x == kSide) + 2 * (y == kSide) + 4 * (z == kSide);
        if (around[k] == nullptr) continue;
        const TsdfVoxel& v = around[k]->voxels[static_cast<std::size_t>(
            FruitTsdf::offset(x % kSide, y % kSide, z % kSide))];
        if (v.weight < kMinWeight) continue;
        corners.voxel[Corners::index(x, y, z)] = &v;
        corners.side[Corners::index(x, y, z)] = v.distance_m < 0.0F ? kInside : kOutside;
      }
    }
  }
  return corners;
}

/// Gradient of the distance in the middle of a cell: the mean difference along each axis.
Vec3 gradient_of(const std::array<const TsdfVoxel*, 8>& c) {
  Vec3 g = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      g[axis] += ((k >> axis) & 1) != 0 ? c[k]->distance_m : -c[k]->distance_m;
    }
  }
  return g;
}

void set_looks(const std::array<const TsdfVoxel*, 8>& c, SurfaceVertex& vertex) {
  std::array<float, kPixelLabels> votes{};
  std::array<float, 3> color{};
  float color_weight = 1e-6F;
  for (const TsdfVoxel* voxel : c) {
    for (int k = 0; k < kPixelLabels; ++k) votes[k] += voxel->votes[k];
    for (int k = 0; k < 3; ++k) color[k] += voxel->color_weight * voxel->color[k];
    color_weight += voxel->color_weight;
  }
  const float fruit = votes[1] + votes[2] + votes[3];
  vertex.fruit_share = fruit / std::max(1e-6F, fruit + votes[0]);
  const auto most = std::max_element(votes.begin() + 1, votes.end());
  vertex.kind = static_cast<PixelLabel>(most - votes.begin());
  const auto channel = [&](int k) {
    return static_cast<std::uint8_t>(std::clamp(color[k] / color_weight + 0.5F, 0.0F, 255.0F));
  };
  vertex.color = {channel(0), channel(1), channel(2)};
}

std::optional<SurfaceVertex> vertex_of(const std::array<const TsdfVoxel*, 8>& c,
                                       const VoxelIndex& cell, double voxel_m) {
  Vec3 sum = Vec3::Zero();
  int crossings = 0;
  for (const auto& [a, b] : kEdges) {
    const float da = c[a]->distance_m;
    const float db = c[b]->distance_m;
    if ((da < 0.0F) == (db < 0.0F)) continue;
    const double t = da / (da - db);
    const Vec3 from(a & 1, (a >> 1) & 1, a >> 2);
    const Vec3 to(b & 1, (b >> 1) & 1, b >> 2);
    sum += from + t * (to - from);
    ++crossings;
  }
  if (crossings == 0) return std::nullopt;
  const Vec3 gradient = gradient_of(c);
  if (!(gradient.norm() > 1e-9)) return std::nullopt;
  SurfaceVertex vertex;
  vertex.cell = cell;
  vertex.surface.point = voxel_centre(cell, voxel_m) + voxel_m * sum / crossings;
  vertex.surface.normal = gradient.normalized();
  set_looks(c, vertex);
  return vertex;
}

}  // namespace

std::vector<SurfaceVertex> FruitSurface::extract(const FruitTsdf::Block& block) const {
  const Corners corners = corners_of(tsdf_, block);
  std::vector<SurfaceVertex> vertices;
  std::array<const TsdfVoxel*, 8> c{};
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (!corners.crossed(x, y, z)) continue;
        for (int k = 0; k < 8; ++k) {
          c[k] = corners.voxel[Corners::index(x + (k & 1), y + ((k >> 1) & 1), z + (k >> 2))];
        }
        const VoxelIndex cell = block.index * kSide + VoxelIndex(x, y, z);
        auto vertex = vertex_of(c, cell, tsdf_.options().voxel_m);
        if (vertex) vertices.push_back(*vertex);
      }
    }
  }
  return vertices;
}

std::vector<int> FruitSurface::update() {
  const std::vector<int> remade = tsdf_.take_changed();
  vertices_.resize(tsdf_.blocks().size());
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
  const auto distance_at = [&](const VoxelIndex& voxel) -> std::optional<float> {
    const VoxelIndex block(voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3);
    const int number = tsdf_.block_at(block);
    if (number < 0) return std::nullopt;
    const VoxelIndex in = voxel - block * kSide;
    const TsdfVoxel& v =
        tsdf_.blocks()[static_cast<std::size_t>(number)]
            ->voxels[static_cast<std::size_t>(FruitTsdf::offset(in.x(), in.y(), in.z()))];
    if (v.weight < kMinWeight) return std::nullopt;
    return v.distance_m;
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const VoxelIndex cell = mesh.vertices[i].cell;
    for (int axis = 0; axis < 3; ++axis) {
      const VoxelIndex up = VoxelIndex::Unit(axis);
      const VoxelIndex b = VoxelIndex::Unit((axis + 1) % 3);
      const VoxelIndex c = VoxelIndex::Unit((axis + 2) % 3);
      const auto low = distance_at(cell);
      const auto high = distance_at(cell + up);
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
