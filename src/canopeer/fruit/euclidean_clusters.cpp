#include "canopeer/fruit/euclidean_clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "canopeer/fruit/voxel_key.h"

namespace canopeer {
namespace {

/// Cells of a grid by their keys: open addressing, as the lookups are what all the time goes into.
class CellTable {
 public:
  explicit CellTable(std::size_t cells)
      : mask_(std::bit_ceil(2 * cells + 1) - 1), keys_(mask_ + 1, kEmpty), first_(mask_ + 1, -1) {}

  /// Place of the cell's first point, made −1 when the cell is new.
  int& at(std::uint64_t key) {
    const std::size_t slot = slot_of(key);
    keys_[slot] = key;
    return first_[slot];
  }
  [[nodiscard]] int find(std::uint64_t key) const {
    const std::size_t slot = slot_of(key);
    return keys_[slot] == key ? first_[slot] : -1;
  }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    std::size_t slot = (key * 0x9E3779B97F4A7C15U >> 20U) & mask_;
    while (keys_[slot] != kEmpty && keys_[slot] != key) slot = (slot + 1) & mask_;
    return slot;
  }

  std::size_t mask_;
  std::vector<std::uint64_t> keys_;
  std::vector<int> first_;
};

/// Half of the cells in reach: the other half looks this way.
std::vector<VoxelIndex> half_of_the_neighbours() {
  std::vector<VoxelIndex> offsets;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)))) offsets.emplace_back(x, y, z);
      }
    }
  }
  return offsets;
}

}  // namespace

std::vector<int> euclidean_clusters(std::span<const SurfacePoint> points, double tolerance_m) {
  // In a cell of this side any two points are within the tolerance, so a cell is one cluster.
  const double side = tolerance_m / std::sqrt(3.0) * (1.0 - 1e-9);
  CellTable table(points.size());
  std::vector<int> next_in_cell(points.size(), -1);
  std::vector<int> parent(points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto unite = [&](int a, int b) { parent[std::max(a, b)] = std::min(a, b); };
  std::vector<int> firsts;
  std::vector<VoxelIndex> cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const VoxelIndex cell = voxel_at(points[i].point, side);
    int& first = table.at(voxel_key(cell));
    const int number = static_cast<int>(i);
    if (first < 0) {
      first = number;
      firsts.push_back(number);
      cells.push_back(cell);
    } else {
      next_in_cell[i] = next_in_cell[first];
      next_in_cell[first] = number;
      parent[i] = first;
    }
  }
  static const std::vector<VoxelIndex> neighbours = half_of_the_neighbours();
  const double tolerance2 = tolerance_m * tolerance_m;
  const auto touch = [&](int a, int b) {
    for (int i = a; i >= 0; i = next_in_cell[i]) {
      for (int j = b; j >= 0; j = next_in_cell[j]) {
        if ((points[i].point - points[j].point).squaredNorm() <= tolerance2) return true;
      }
    }
    return false;
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const VoxelIndex& offset : neighbours) {
      const int other = table.find(voxel_key(cells[c] + offset));
      if (other < 0) continue;
      const int a = root(firsts[c]);
      const int b = root(other);
      if (a != b && touch(firsts[c], other)) unite(a, b);
    }
  }
  std::vector<int> number_of_root(points.size(), -1);
  std::vector<int> cluster(points.size());
  int clusters = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    int& number = number_of_root[root(static_cast<int>(i))];
    if (number < 0) number = clusters++;
    cluster[i] = number;
  }
  return cluster;
}

}  // namespace canopeer
