#include "canopeer/map/distances/distance_tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

constexpr int kSide = kTileSide;
constexpr int kLine = 64;  // bytes
constexpr int kMostReach = 120;
constexpr int kMaxWide = kSide + 2 * kMostReach;

// The passes' memory, cells of 8 or 16 bits. Rows lie along x and begin and end with whole lines.
template <typename Cell>
struct Passes {
  static constexpr int kLanes = kLine / static_cast<int>(sizeof(Cell));

  int reach = 0;
  int pad = 0;     // voxels beside the tile, ≥ reach
  int wide = 0;    // rows and planes, tile and pads
  int stride = 0;  // cells a row
  int deep = 0;    // rows a y of y_pass: odd, or they would all want the same places of the cache
  Cell far = 0;    // reach²
  Cell* plane = nullptr;   // wide rows: 0 where occupied, all bits elsewhere
  Cell* ahead = nullptr;   // kSide rows: distance along y to what comes before
  Cell* y_pass = nullptr;  // [z of wide][y of kSide] rows
  Cell* z_pass = nullptr;  // [z of kSide][y of kSide] rows
  // Per plane the rows y of the tile beyond which nothing is within reach, [first, end).
  std::array<std::uint8_t, kMaxWide> first{}, end{};
};

template <typename Cell>
struct Vectors;
template <>
struct Vectors<std::uint8_t> {
  using Line = std::uint8_t __attribute__((vector_size(kLine)));
  using TileRow = std::uint8_t __attribute__((vector_size(kSide)));
};
template <>
struct Vectors<std::uint16_t> {
  using Line = std::uint16_t __attribute__((vector_size(kLine)));
  using TileRow = std::uint16_t __attribute__((vector_size(2 * kSide)));
};
template <typename Cell>
using Line = typename Vectors<Cell>::Line;
template <typename Cell>
using TileRow = typename Vectors<Cell>::TileRow;

template <typename Vector, typename Cell>
CANOPEER_KERNEL_BODY void load(Vector& lanes, const Cell* from) {
  std::memcpy(&lanes, from, sizeof lanes);
}
template <typename Vector, typename Cell>
CANOPEER_KERNEL_BODY void store(const Vector& lanes, Cell* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}
template <typename Vector>
CANOPEER_KERNEL_BODY void lower(Vector& lanes, const Vector& other) {
  lanes = other < lanes ? other : lanes;
}

// What of `Passes` the compiler may know beforehand, so that it unrolls the loops; 0: nothing.
template <int kReach, int kStride>
struct Fixed {
  template <typename Cell>
  static constexpr int reach(const Passes<Cell>& p) {
    return kReach != 0 ? kReach : p.reach;
  }
  template <typename Cell>
  static constexpr int stride(const Passes<Cell>& p) {
    return kStride != 0 ? kStride : p.stride;
  }
};

// best = least of row + gap²(k) over the rows k lines ahead and behind, lines `apart` cells apart,
// k = 0 … reach. By Horner's rule, from the farthest on: gap²(k + 1) − gap²(k) = 2 k − 1 is so
// small that no sum leaves the cell, as long as rows are at most far.
template <typename Vector, typename Cell>
CANOPEER_KERNEL_BODY void relax(Vector& best, const Cell* row, int apart, int reach) {
  Vector ahead, behind;
  load(best, row + reach * apart);
  load(behind, row - reach * apart);
  lower(best, behind);
#pragma GCC unroll 16
  for (int k = reach - 1; k > 0; --k) {
    load(ahead, row + k * apart);
    load(behind, row - k * apart);
    lower(ahead, behind);
    best += static_cast<Cell>(2 * k - 1);
    lower(best, ahead);
  }
  load(ahead, row);
  lower(best, ahead);
}

// Per value of 8 bits: all ones in the lanes whose bit is not set.
template <typename Cell>
constexpr auto kNotSet = [] {
  std::array<std::array<Cell, kBlockSide>, 256> lanes{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    for (unsigned x = 0; x < kBlockSide; ++x) {
      lanes[bits][x] = static_cast<Cell>((bits >> x & 1U) != 0 ? 0 : ~0);
    }
  }
  return lanes;
}();

struct Rows {
  int first = kMaxWide;
  int last = -kMaxWide;
};

// The blocks of one layer of the surroundings that hold something.
struct OccupiedBlocks {
  struct Block {
    const VoxelMask* mask;
    std::uint8_t x, y;
  };
  static constexpr std::size_t kSideBlocks = kMaxWide / kBlockSide;
  std::array<Block, kSideBlocks * kSideBlocks> blocks;
  std::size_t count = 0;
};

template <typename Cell>
CANOPEER_KERNEL_BODY void find_occupied(const TileSurroundings& around, int layer,
                                        const Passes<Cell>& p, OccupiedBlocks& found) {
  const int blocks = p.wide / kBlockSide;
  const VoxelMask* first = around.first + static_cast<std::size_t>(layer) * around.stride_z;
  found.count = 0;
  for (int y = 0; y < blocks; ++y) {
    for (int x = 0; x < blocks; ++x) {
      const VoxelMask& mask =
          first[static_cast<std::size_t>(y) * around.stride_y + static_cast<std::size_t>(x)];
      found.blocks[found.count] = {&mask, static_cast<std::uint8_t>(x),
                                   static_cast<std::uint8_t>(y)};
      found.count += mask.any();
    }
  }
}

// A plane of a layer; returns the rows between which something is occupied. Where there is nothing,
// `p.plane` is left alone.
template <typename Cell>
CANOPEER_KERNEL_BODY Rows expand_plane(const OccupiedBlocks& layer, std::size_t slice,
                                       const Passes<Cell>& p) {
  Rows occupied;
  for (std::size_t i = 0; i < layer.count; ++i) {
    const auto& [mask, x, y] = layer.blocks[i];
    const std::uint64_t bits = mask->slices[slice];
    if (bits == 0) continue;
    if (occupied.last < 0) {
      std::memset(p.plane, 0xFF, sizeof(Cell) * static_cast<std::size_t>(p.wide * p.stride));
    }
    const int from = y * kBlockSide;
    occupied.first = std::min(occupied.first, from + std::countr_zero(bits) / kBlockSide);
    occupied.last = std::max(occupied.last, from + (63 - std::countl_zero(bits)) / kBlockSide);
    Cell* rows = p.plane + from * p.stride + x * kBlockSide;
    for (int row = 0; row < kBlockSide; ++row) {
      store(kNotSet<Cell>[bits >> (row * kBlockSide) & 0xFF], rows + row * p.stride);
    }
  }
  return occupied;
}

// Squared gaps along y in plane z: two sweeps that count the rows since the last occupied voxel.
template <typename Cell>
CANOPEER_KERNEL_BODY void sweep_plane(const Passes<Cell>& p, int z) {
  Cell* out = p.y_pass + z * p.stride;
  const Line<Cell> limit = Line<Cell>{} + static_cast<Cell>(p.reach + 1);
  const auto one = static_cast<Cell>(1);
  for (int x = 0; x < p.stride; x += p.kLanes) {
    Line<Cell> since = limit, occupied;
    const auto advance = [&](int y) __attribute__((always_inline)) {
      load(occupied, p.plane + y * p.stride + x);
      since += one;
      lower(since, limit);
      since &= occupied;
    };
    for (int y = p.pad - p.reach; y < p.pad + kSide; ++y) {
      advance(y);
      if (y >= p.pad) store(since, p.ahead + (y - p.pad) * p.stride + x);
    }
    since = limit;
    for (int y = p.pad + kSide + p.reach - 1; y >= p.pad; --y) {
      advance(y);
      if (y >= p.pad + kSide) continue;
      Line<Cell> gap;
      load(gap, p.ahead + (y - p.pad) * p.stride + x);
      lower(gap, since);
      gap = gap > one ? gap - one : Line<Cell>{};
      gap *= gap;
      store(gap, out + (y - p.pad) * p.deep * p.stride + x);
    }
  }
}

template <typename Cell>
CANOPEER_KERNEL_BODY bool run_y_pass(const TileSurroundings& around, Passes<Cell>& p) {
  bool any = false;
  OccupiedBlocks layer;
  for (int z = p.pad - p.reach; z < p.pad + kSide + p.reach; ++z) {
    if (z == p.pad - p.reach || z % kBlockSide == 0)
      find_occupied(around, z / kBlockSide, p, layer);
    const Rows occupied = expand_plane(layer, static_cast<std::size_t>(z % kBlockSide), p);
    const int first = std::clamp(occupied.first - p.reach - p.pad, 0, kSide);
    const int end = std::clamp(occupied.last + p.reach + 1 - p.pad, 0, kSide);
    p.first[z] = static_cast<std::uint8_t>(first);
    p.end[z] = static_cast<std::uint8_t>(end);
    if (first < end) {
      any = true;
      sweep_plane(p, z);
      continue;
    }
    for (int y = 0; y < kSide; ++y) {
      std::fill_n(p.y_pass + (y * p.deep + z) * p.stride, p.stride, p.far);
    }
  }
  return any;
}

// The row z of the tile (with its pads along x) from the rows of y_pass at some y; false: all far.
template <typename Known, typename Cell>
CANOPEER_KERNEL_BODY bool relax_along_z(const Passes<Cell>& p, int y, int z) {
  const auto used = [&](int plane) { return y >= p.first[plane] && y < p.end[plane]; };
  int nearest = 0;
  while (nearest <= p.reach && !used(z + p.pad + nearest) && !used(z + p.pad - nearest)) ++nearest;
  if (nearest > p.reach) return false;
  for (int x = 0; x < Known::stride(p); x += p.kLanes) {
    Line<Cell> best;
    relax(best, p.y_pass + (y * p.deep + z + p.pad) * Known::stride(p) + x, Known::stride(p),
          Known::reach(p));
    store(best, p.z_pass + z * Known::stride(p) + x);
  }
  return true;
}

template <typename Known, typename Cell>
CANOPEER_KERNEL_BODY void relax_along_x(const Passes<Cell>& p, int z, Cell* out) {
  TileRow<Cell> best;
  relax(best, p.z_pass + z * Known::stride(p) + p.pad, 1, Known::reach(p));
  store(best, out);
}

template <typename Known, typename Cell>
CANOPEER_KERNEL_BODY void run_z_and_x_pass(const Passes<Cell>& p, Cell* cells) {
  std::array<bool, kSide> used;
  for (int y = 0; y < kSide; ++y) {
    for (int z = 0; z < kSide; ++z) used[z] = relax_along_z<Known>(p, y, z);
    for (int z = 0; z < kSide; ++z) {
      Cell* row = cells + (z * kSide + y) * kSide;
      if (used[z]) {
        relax_along_x<Known>(p, z, row);
      } else {
        std::fill_n(row, kSide, p.far);
      }
    }
  }
}

template <typename Cell>
CANOPEER_KERNEL_BODY bool run_body(const TileSurroundings& around, Passes<Cell>& p,
                                   std::vector<std::uint8_t>& out) {
  if (!run_y_pass(around, p)) return false;
  out.resize(sizeof(Cell) * kSide * kSide * kSide);
  auto* cells = reinterpret_cast<Cell*>(out.data());
  if (sizeof(Cell) == 1 && p.reach == 15 && p.stride == kLine) {
    run_z_and_x_pass<Fixed<15, kLine>>(p, cells);
  } else {
    run_z_and_x_pass<Fixed<0, 0>>(p, cells);
  }
  return true;
}

#define CANOPEER_KERNELS(NAME, TARGET)                                    \
  template <typename Cell>                                                \
  TARGET bool run_##NAME(const TileSurroundings& around, Passes<Cell>& p, \
                         std::vector<std::uint8_t>& out) {                \
    return run_body(around, p, out);                                      \
  }

CANOPEER_EACH_LEVEL(CANOPEER_KERNELS)

template <typename Cell>
struct Kernels {
  static constexpr auto kRun_scalar = run_scalar<Cell>;
#if defined(__x86_64__)
  static constexpr auto kRun_avx2 = run_avx2<Cell>;
  static constexpr auto kRun_avx512 = run_avx512<Cell>;
#endif
};

template <typename Cell>
Passes<Cell> take_memory(int halo, int reach, TileScratch& scratch) {
  Passes<Cell> p;
  p.reach = reach;
  p.pad = halo * kBlockSide;
  p.wide = kSide + 2 * p.pad;
  p.stride = (p.wide + p.kLanes - 1) / p.kLanes * p.kLanes;
  p.far = static_cast<Cell>(reach * reach);
  const int row_lines = p.stride / p.kLanes;
  p.deep = p.wide + 1;
  const int rows = p.wide + kSide + kSide * p.deep + kSide;
  scratch.lines.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(row_lines));
  p.plane = reinterpret_cast<Cell*>(scratch.lines.data());
  p.ahead = p.plane + p.wide * p.stride;
  p.y_pass = p.ahead + kSide * p.stride;
  p.z_pass = p.y_pass + kSide * p.deep * p.stride;
  return p;
}

template <typename Cell>
void run(const TileSurroundings& around, int reach, TileScratch& scratch,
         std::vector<std::uint8_t>& out, [[maybe_unused]] SimdLevel simd) {
  Passes<Cell> p = take_memory<Cell>(around.halo, reach, scratch);
  if (!CANOPEER_AT_LEVEL(simd, Kernels<Cell>::kRun)(around, p, out))
    std::vector<std::uint8_t>().swap(out);
}

}  // namespace

void tile_distance2(const TileSurroundings& around, int reach, TileScratch& scratch,
                    std::vector<std::uint8_t>& out, SimdLevel simd) {
  if (tile_cell_bytes(reach) == 1) {
    run<std::uint8_t>(around, reach, scratch, out, simd);
  } else {
    run<std::uint16_t>(around, reach, scratch, out, simd);
  }
}

}  // namespace canopeer
