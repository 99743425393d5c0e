#include "canopeer/fruit/euclidean_clusters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "canopeer/fruit/voxel_key.h"

namespace canopeer {
namespace {

/// The first point of each cell of a grid, −1: none. Cells come in blocks of 8³ that are found by
/// their keys once; most lookups stay within one, as they are what all the time goes into.
class CellGrid {
 public:
  static constexpr int kSide = 8;
  using Block = std::array<int, kSide * kSide * kSide>;

  /// `points`: an upper limit of the blocks.
  explicit CellGrid(std::size_t points)
      : mask_(std::bit_ceil(2 * points + 1) - 1), slots_(mask_ + 1, Slot{0, -1}) {}

  int& at(const VoxelIndex& cell) {
    const std::size_t slot = slot_of(voxel_key(block_of(cell)));
    if (slots_[slot].block < 0) {
      slots_[slot] = {voxel_key(block_of(cell)), static_cast<int>(blocks_.size())};
      blocks_.emplace_back().fill(-1);
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
    std::size_t slot = (key * 0x9E3779B97F4A7C15U >> 20U) & mask_;
    while (slots_[slot].block >= 0 && slots_[slot].key != key) slot = (slot + 1) & mask_;
    return slot;
  }

  std::size_t mask_;
  std::vector<Slot> slots_;
  std::vector<Block> blocks_;
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
  CellGrid grid(points.size());
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
    int& first = grid.at(cell);
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
  VoxelIndex last_block = VoxelIndex::Constant(1 << 20);
  std::array<const CellGrid::Block*, 27> around{};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const VoxelIndex block = CellGrid::block_of(cells[c]);
    if (block != last_block) around = grid.around(cells[c]);
    last_block = block;
    const VoxelIndex in_block(cells[c].x() & 7, cells[c].y() & 7, cells[c].z() & 7);
    for (const VoxelIndex& offset : neighbours) {
      // Up to two cells below or above: 8 is added so that shifting rounds down.
      const VoxelIndex near = in_block + offset + VoxelIndex::Constant(8);
      const CellGrid::Block* held =
          around[(near.x() >> 3) + 3 * (near.y() >> 3) + 9 * (near.z() >> 3)];
      const int other = held == nullptr ? -1 : (*held)[CellGrid::offset(near)];
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
