#include "canopeer/fruit/instances/euclidean_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "canopeer/fruit/surface/voxel_key.h"

namespace canopeer {
namespace {

/// A cell of a grid: its first point, −1: none; and whether its points are known to be of one
/// cluster.
struct Cell {
  int first = -1;
  bool single = true;
};

/// Cells in blocks of 8³ that are found by their keys once; most lookups stay within one.
class CellGrid {
 public:
  static constexpr int kSide = 8;
  using Block = std::array<Cell, kSide * kSide * kSide>;

  Cell& at(const VoxelIndex& cell) {
    const std::uint64_t key = voxel_key(block_of(cell));
    std::size_t slot = slot_of(key);
    if (slots_[slot].block < 0) {
      if (2 * blocks_.size() >= slots_.size()) {
        grow();
        slot = slot_of(key);
      }
      slots_[slot] = {key, static_cast<int>(blocks_.size())};
      blocks_.emplace_back();
    }
    return blocks_[static_cast<std::size_t>(slots_[slot].block)][offset(cell)];
  }

  /// The 27 blocks around and with that of `cell`, x fastest; null: holds nothing.
  [[nodiscard]] std::array<const Block*, 27> around(const VoxelIndex& cell) const {
    std::array<const Block*, 27> blocks{};
    for (int k = 0; k < 27; ++k) {
      const VoxelIndex index = block_of(cell) + VoxelIndex(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const Slot& slot = slots_[slot_of(voxel_key(index))];
      if (slot.block >= 0) blocks[k] = &blocks_[static_cast<std::size_t>(slot.block)];
    }
    return blocks;
  }

  static VoxelIndex block_of(const VoxelIndex& cell) {
    return {cell.x() >> 3, cell.y() >> 3, cell.z() >> 3};
  }
  static std::size_t offset(const VoxelIndex& cell) {
    return static_cast<std::size_t>((cell.x() & 7) +
                                    kSide * ((cell.y() & 7) + kSide * (cell.z() & 7)));
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    int block = -1;
  };

  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (key * 0x9E3779B97F4A7C15U >> 20U) & mask;
    while (slots_[slot].block >= 0 && slots_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old) {
      if (slot.block >= 0) slots_[slot_of(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(64);  // a power of two, half of them free at least
  std::vector<Block> blocks_;
};

/// Half of the cells around: the other half looks this way.
std::vector<VoxelIndex> half_of_the_neighbours() {
  std::vector<VoxelIndex> offsets;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)))) offsets.emplace_back(x, y, z);
      }
    }
  }
  return offsets;
}

/// Clusters as sets that are united; a set is known by its lowest point.
class Clusters {
 public:
  Clusters(std::span<const SurfacePoint> points, double tolerance_m)
      : points_(points),
        tolerance2_(tolerance_m * tolerance_m),
        next_in_cell_(points.size(), -1),
        parent_(points.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    // Points within the tolerance are in one cell or in two that touch.
    const double side = tolerance_m * (1.0 + 1e-9);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const VoxelIndex index = voxel_at(points[i].point, side);
      Cell& cell = grid_.at(index);
      const int number = static_cast<int>(i);
      if (cell.first < 0) {
        cells_.push_back(index);
      } else {
        next_in_cell_[i] = cell.first;
      }
      cell.first = number;
    }
    for (const VoxelIndex& index : cells_) unite_within(grid_.at(index));
    unite_neighbours();
  }

  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  [[nodiscard]] bool touch(int a, int b) const {
    return (points_[a].point - points_[b].point).squaredNorm() <= tolerance2_;
  }

  void unite(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  void unite_within(Cell& cell) {
    for (int i = cell.first; i >= 0; i = next_in_cell_[i]) {
      for (int j = next_in_cell_[i]; j >= 0; j = next_in_cell_[j]) {
        if (root(i) != root(j) && touch(i, j)) unite(i, j);
      }
    }
    for (int i = cell.first; i >= 0; i = next_in_cell_[i]) {
      cell.single = cell.single && root(i) == root(cell.first);
    }
  }

  /// Between two cells of one cluster each, the first two points that touch are enough.
  void unite(const Cell& a, const Cell& b) {
    const bool single = a.single && b.single;
    if (single && root(a.first) == root(b.first)) return;
    for (int i = a.first; i >= 0; i = next_in_cell_[i]) {
      for (int j = b.first; j >= 0; j = next_in_cell_[j]) {
        if (!touch(i, j)) continue;
        unite(i, j);
        if (single) return;
      }
    }
  }

  void unite_neighbours() {
    static const std::vector<VoxelIndex> neighbours = half_of_the_neighbours();
    VoxelIndex last_block = VoxelIndex::Constant(1 << 20);
    std::array<const CellGrid::Block*, 27> around{};
    for (const VoxelIndex& index : cells_) {
      const VoxelIndex block = CellGrid::block_of(index);
      if (block != last_block) around = grid_.around(index);
      last_block = block;
      const Cell& cell = (*around[13])[CellGrid::offset(index)];
      const VoxelIndex in_block(index.x() & 7, index.y() & 7, index.z() & 7);
      for (const VoxelIndex& offset : neighbours) {
        // One cell below or above: 8 is added so that shifting rounds down.
        const VoxelIndex near = in_block + offset + VoxelIndex::Constant(8);
        const CellGrid::Block* held =
            around[(near.x() >> 3) + 3 * (near.y() >> 3) + 9 * (near.z() >> 3)];
        if (held == nullptr) continue;
        const Cell& other = (*held)[CellGrid::offset(near)];
        if (other.first >= 0) unite(cell, other);
      }
    }
  }

  std::span<const SurfacePoint> points_;
  double tolerance2_;
  CellGrid grid_;
  std::vector<VoxelIndex> cells_;
  std::vector<int> next_in_cell_;
  std::vector<int> parent_;
};

}  // namespace

std::vector<int> euclidean_clusters(std::span<const SurfacePoint> points, double tolerance_m) {
  Clusters sets(points, tolerance_m);
  std::vector<int> number_of_root(points.size(), -1);
  std::vector<int> cluster(points.size());
  int clusters = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    int& number = number_of_root[sets.root(static_cast<int>(i))];
    if (number < 0) number = clusters++;
    cluster[i] = number;
  }
  return cluster;
}

}  // namespace canopeer
