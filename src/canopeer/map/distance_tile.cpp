#include "canopeer/map/distance_tile.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "canopeer/map/kernel_targets.h"

namespace canopeer {
namespace {

constexpr int kSide = kTileSide;
constexpr int kLine = 64;  // bytes

// The passes' memory, cells of 8 or 16 bits. Rows lie along x and begin and end with whole lines.
template <typename Cell>
struct Passes {
  static constexpr int kLanes = kLine / static_cast<int>(sizeof(Cell));

  int reach = 0;
  int pad = 0;     // voxels beside the tile, ≥ reach
  int wide = 0;    // rows and planes, tile and pads
  int stride = 0;  // cells a row
  Cell far = 0;    // reach²
  // Per k ≤ reach a line of gap²(k) and one of far − gap²(k).
  Cell* steps = nullptr;
  Cell* limits = nullptr;
  Cell* plane = nullptr;             // wide rows: 0 where occupied, all bits elsewhere
  Cell* ahead = nullptr;             // kSide rows: distance along y to what comes before
  Cell* y_pass = nullptr;            // [z of wide][y of kSide] rows
  Cell* z_pass = nullptr;            // [z of kSide][y of kSide] rows
  std::uint8_t* row_used = nullptr;  // of the plane: something occupied
  std::uint8_t* y_used = nullptr;    // of y_pass: something nearer than far
  std::uint8_t* z_used = nullptr;
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

// best = min(best, far, row one + step, row other + step); no sum exceeds far.
template <typename Vector, typename Cell>
CANOPEER_KERNEL_BODY void relax(Vector& best, const Cell* one, const Cell* other,
                                const Cell* limit_line, const Cell* step_line) {
  Vector candidate, second, limit, step;
  load(candidate, one);
  load(second, other);
  load(limit, limit_line);
  load(step, step_line);
  lower(candidate, second);
  lower(candidate, limit);
  candidate += step;
  lower(best, candidate);
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

// The plane z of the surroundings; false: nothing there.
template <typename Cell>
CANOPEER_KERNEL_BODY bool expand_plane(const TileSurroundings& around, int z,
                                       const Passes<Cell>& p) {
  const int blocks = p.wide / kBlockSide;
  const VoxelMask* layer =
      around.first + static_cast<std::size_t>(z / kBlockSide) * around.stride_z;
  const auto slice = static_cast<std::size_t>(z % kBlockSide);
  bool any = false;
  for (int by = 0; by < blocks; ++by) {
    Cell* rows = p.plane + by * kBlockSide * p.stride;
    std::memset(rows, 0xFF, sizeof(Cell) * static_cast<std::size_t>(kBlockSide * p.stride));
    std::uint64_t used = 0;
    for (int bx = 0; bx < blocks; ++bx) {
      const std::uint64_t bits =
          layer[static_cast<std::size_t>(by) * around.stride_y + static_cast<std::size_t>(bx)]
              .slices[slice];
      if (bits == 0) continue;
      used |= bits;
      for (int y = 0; y < kBlockSide; ++y) {
        store(kNotSet<Cell>[bits >> (y * kBlockSide) & 0xFF],
              rows + y * p.stride + bx * kBlockSide);
      }
    }
    for (int y = 0; y < kBlockSide; ++y) {
      p.row_used[by * kBlockSide + y] = (used >> (y * kBlockSide) & 0xFF) != 0;
    }
    any |= used != 0;
  }
  return any;
}

// Squared gaps along y in plane z: two sweeps that count the rows since the last occupied voxel.
template <typename Cell>
CANOPEER_KERNEL_BODY void sweep_plane(const Passes<Cell>& p, int z) {
  Cell* out = p.y_pass + z * kSide * p.stride;
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
      store(gap, out + (y - p.pad) * p.stride + x);
    }
  }
}

// used[y]: some row of the plane within reach is.
template <typename Cell>
CANOPEER_KERNEL_BODY void find_used(const Passes<Cell>& p, std::uint8_t* used) {
  int last = -p.wide;
  for (int y = p.pad - p.reach, next = y; y < p.pad + kSide + p.reach; ++y) {
    if (p.row_used[y] == 0) continue;
    last = y;
    for (next = std::max({next, p.pad, last - p.reach});
         next < std::min(last + p.reach + 1, p.pad + kSide); ++next) {
      used[next - p.pad] = 1;
    }
  }
}

template <typename Cell>
CANOPEER_KERNEL_BODY bool run_y_pass(const TileSurroundings& around, const Passes<Cell>& p) {
  std::fill_n(p.y_used, p.wide * kSide, std::uint8_t{0});
  bool any = false;
  for (int z = p.pad - p.reach; z < p.pad + kSide + p.reach; ++z) {
    std::uint8_t* used = p.y_used + z * kSide;
    if (expand_plane(around, z, p)) {
      find_used(p, used);
      if (std::find(used, used + kSide, 1) != used + kSide) {
        any = true;
        sweep_plane(p, z);
        continue;
      }
    }
    std::fill_n(p.y_pass + z * kSide * p.stride, kSide * p.stride, p.far);
  }
  return any;
}

template <typename Cell>
CANOPEER_KERNEL_BODY void run_z_pass(const Passes<Cell>& p) {
  const int plane = kSide * p.stride;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      const int middle = z + p.pad;
      const auto used = [&](int k) {
        return (p.y_used[(middle + k) * kSide + y] | p.y_used[(middle - k) * kSide + y]) != 0;
      };
      int first = 0;
      while (first <= p.reach && !used(first)) ++first;
      p.z_used[z * kSide + y] = first <= p.reach;
      for (int x = 0; first <= p.reach && x < p.stride; x += p.kLanes) {
        Line<Cell> best = Line<Cell>{} + p.far;
        const Cell* row = p.y_pass + middle * plane + y * p.stride + x;
        for (int k = first; k <= p.reach; ++k) {
          relax(best, row + k * plane, row - k * plane, p.limits + k * p.kLanes,
                p.steps + k * p.kLanes);
        }
        store(best, p.z_pass + z * plane + y * p.stride + x);
      }
    }
  }
}

template <typename Cell>
CANOPEER_KERNEL_BODY void run_x_pass(const Passes<Cell>& p, std::uint8_t* out) {
  for (int i = 0; i < kSide * kSide; ++i) {
    TileRow<Cell> best = TileRow<Cell>{} + p.far;
    const Cell* row = p.z_pass + i * p.stride + p.pad;
    for (int k = 0; p.z_used[i] != 0 && k <= p.reach; ++k) {
      relax(best, row + k, row - k, p.limits + k * p.kLanes, p.steps + k * p.kLanes);
    }
    store(best, out + static_cast<std::size_t>(i) * sizeof best);
  }
}

template <typename Cell>
CANOPEER_KERNEL_BODY bool run_body(const TileSurroundings& around, const Passes<Cell>& p,
                                   std::vector<std::uint8_t>& out) {
  if (!run_y_pass(around, p)) return false;
  run_z_pass(p);
  out.resize(kSide * kSide * kSide * sizeof(Cell));
  run_x_pass(p, out.data());
  return true;
}

#define CANOPEER_KERNELS(NAME, TARGET)                                          \
  template <typename Cell>                                                      \
  TARGET bool run_##NAME(const TileSurroundings& around, const Passes<Cell>& p, \
                         std::vector<std::uint8_t>& out) {                      \
    return run_body(around, p, out);                                            \
  }

CANOPEER_KERNELS(scalar, )
#if defined(__x86_64__)
CANOPEER_KERNELS(avx2, CANOPEER_TARGET_AVX2)
CANOPEER_KERNELS(avx512, CANOPEER_TARGET_AVX512)
#endif

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
  const int rows = p.wide + kSide + p.wide * kSide + kSide * kSide;
  scratch.lines.resize(static_cast<std::size_t>(2 * (reach + 1) + rows * row_lines));
  scratch.used.resize(static_cast<std::size_t>(p.wide + p.wide * kSide + kSide * kSide));
  p.steps = reinterpret_cast<Cell*>(scratch.lines.data());
  p.limits = p.steps + (reach + 1) * p.kLanes;
  p.plane = p.limits + (reach + 1) * p.kLanes;
  p.ahead = p.plane + p.wide * p.stride;
  p.y_pass = p.ahead + kSide * p.stride;
  p.z_pass = p.y_pass + p.wide * kSide * p.stride;
  p.row_used = scratch.used.data();
  p.y_used = p.row_used + p.wide;
  p.z_used = p.y_used + p.wide * kSide;
  for (int k = 0; k <= reach; ++k) {
    const int gap = std::max(0, k - 1);
    std::fill_n(p.steps + k * p.kLanes, p.kLanes, static_cast<Cell>(gap * gap));
    std::fill_n(p.limits + k * p.kLanes, p.kLanes, static_cast<Cell>(p.far - gap * gap));
  }
  return p;
}

template <typename Cell>
void run(const TileSurroundings& around, int reach, TileScratch& scratch,
         std::vector<std::uint8_t>& out, [[maybe_unused]] SimdLevel simd) {
  const Passes<Cell> p = take_memory<Cell>(around.halo, reach, scratch);
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
