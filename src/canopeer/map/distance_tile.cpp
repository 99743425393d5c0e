#include "canopeer/map/distance_tile.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "canopeer/map/kernel_targets.h"

namespace canopeer {
namespace {

constexpr std::size_t kSide = kTileSide;

CANOPEER_KERNEL_BODY std::int16_t gap2(int voxels_apart) {
  const int gap = std::max(0, std::abs(voxels_apart) - 1);
  return static_cast<std::int16_t>(gap * gap);
}

// A row of the tile in registers: one, two or four of them.
using TileRow = std::int16_t __attribute__((vector_size(kSide * sizeof(std::int16_t))));

// best = min(best, row at `from` + step).
#define CANOPEER_RELAX(best, from, step)               \
  do {                                                 \
    TileRow candidate;                                 \
    std::memcpy(&candidate, (from), sizeof candidate); \
    candidate += static_cast<std::int16_t>(step);      \
    (best) = candidate < (best) ? candidate : (best);  \
  } while (false)

// The same with two rows that are as far away.
#define CANOPEER_RELAX_BOTH(best, one, other, step)              \
  do {                                                           \
    TileRow candidate, candidate2;                               \
    std::memcpy(&candidate, (one), sizeof candidate);            \
    std::memcpy(&candidate2, (other), sizeof candidate2);        \
    candidate = candidate2 < candidate ? candidate2 : candidate; \
    candidate += static_cast<std::int16_t>(step);                \
    (best) = candidate < (best) ? candidate : (best);            \
  } while (false)

// Some lane is larger than `limit`.
CANOPEER_KERNEL_BODY bool any_above(const TileRow& row, std::int16_t limit) {
  const TileRow above = row > limit;
  std::uint64_t words[sizeof(TileRow) / 8];
  std::memcpy(words, &above, sizeof words);
  std::uint64_t any = 0;
  for (const std::uint64_t word : words) any |= word;
  return any != 0;
}

// out[j] = min over |k| ≤ reach of rows[(j + k) · stride] + gap²(k), for kSide rows that are
// `stride` rows apart; rows without a mark hold nothing nearer than `far`. From the middle
// outwards: what is farther than all that was found changes nothing.
CANOPEER_KERNEL_BODY void relax_rows_body(const std::int16_t* rows, const std::uint8_t* used,
                                          std::size_t stride, int pad, int reach, std::int16_t far,
                                          std::int16_t* out, std::uint8_t* out_used,
                                          std::size_t out_stride) {
  for (std::size_t j = 0; j < kSide; ++j) {
    TileRow best = TileRow{} + far;
    std::uint8_t any = 0;
    for (int k = 0; k <= reach; ++k) {
      const std::int16_t step = gap2(k);
      const std::size_t middle = j + static_cast<std::size_t>(pad);
      const std::size_t after = (middle + static_cast<std::size_t>(k)) * stride;
      const std::size_t before = (middle - static_cast<std::size_t>(k)) * stride;
      if ((used[after] | used[before]) == 0) continue;
      any = 1;
      if (k > 1 && !any_above(best, step)) break;
      if (used[after] != 0 && used[before] != 0) {
        CANOPEER_RELAX_BOTH(best, rows + after * kSide, rows + before * kSide, step);
      } else {
        CANOPEER_RELAX(best, rows + (used[after] != 0 ? after : before) * kSide, step);
      }
    }
    std::memcpy(out + j * out_stride * kSide, &best, sizeof best);
    if (out_used != nullptr) out_used[j * out_stride] = any;
  }
}

CANOPEER_KERNEL_BODY void relax_row_body(const std::int16_t* padded, int pad, int reach,
                                         std::int16_t far, std::int16_t* out) {
  TileRow best = TileRow{} + far;
  for (int k = 0; k <= reach; ++k) {
    const std::int16_t step = gap2(k);
    if (k > 1 && !any_above(best, step)) break;
    CANOPEER_RELAX_BOTH(best, padded + (pad + k), padded + (pad - k), step);
  }
  std::memcpy(out, &best, sizeof best);
}

struct TileKernels {
  void (*relax_rows)(const std::int16_t* rows, const std::uint8_t* used, std::size_t stride,
                     int pad, int reach, std::int16_t far, std::int16_t* out,
                     std::uint8_t* out_used, std::size_t out_stride);
  void (*relax_row)(const std::int16_t* padded, int pad, int reach, std::int16_t far,
                    std::int16_t* out);
};

#define CANOPEER_TILE_KERNELS(NAME, TARGET)                                                       \
  TARGET void relax_rows_##NAME(                                                                  \
      const std::int16_t* rows, const std::uint8_t* used, std::size_t stride, int pad, int reach, \
      std::int16_t far, std::int16_t* out, std::uint8_t* out_used, std::size_t out_stride) {      \
    relax_rows_body(rows, used, stride, pad, reach, far, out, out_used, out_stride);              \
  }                                                                                               \
  TARGET void relax_row_##NAME(const std::int16_t* padded, int pad, int reach, std::int16_t far,  \
                               std::int16_t* out) {                                               \
    relax_row_body(padded, pad, reach, far, out);                                                 \
  }                                                                                               \
  constexpr TileKernels kTile_##NAME = {relax_rows_##NAME, relax_row_##NAME};

CANOPEER_TILE_KERNELS(scalar, )
CANOPEER_TILE_KERNELS(avx2, CANOPEER_TARGET_AVX2)
CANOPEER_TILE_KERNELS(avx512, CANOPEER_TARGET_AVX512)

const TileKernels& tile_kernels(SimdLevel level) {
  return level == SimdLevel::avx512 ? kTile_avx512
         : level == SimdLevel::avx2 ? kTile_avx2
                                    : kTile_scalar;
}

// Per value of 8 bits: all ones in the lanes whose bit is not set.
constexpr auto kNotSet = [] {
  std::array<std::array<std::int16_t, kBlockSide>, 256> lanes{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    for (unsigned x = 0; x < kBlockSide; ++x) {
      lanes[bits][x] = (bits >> x & 1U) != 0 ? std::int16_t{0} : std::int16_t{-1};
    }
  }
  return lanes;
}();

// 0 where occupied, `far` elsewhere, along the padded row (y, z); false: all far.
bool expand_row(const TileSurroundings& around, int y, int z, std::int16_t far,
                std::vector<std::int16_t>& padded) {
  const VoxelMask* blocks = around.first +
                            static_cast<std::size_t>(y / kBlockSide) * around.stride_y +
                            static_cast<std::size_t>(z / kBlockSide) * around.stride_z;
  const auto slice = static_cast<std::size_t>(z % kBlockSide);
  const int shift = y % kBlockSide * kBlockSide;
  const std::size_t count = padded.size() / kBlockSide;
  const auto row_bits = [&](std::size_t b) {
    return static_cast<unsigned>(blocks[b].slices[slice] >> shift & 0xFF);
  };
  unsigned any = 0;
  for (std::size_t b = 0; b < count; ++b) any |= row_bits(b);
  if (any == 0) return false;
  for (std::size_t b = 0; b < count; ++b) {
    const auto& lanes = kNotSet[row_bits(b)];
    for (std::size_t x = 0; x < kBlockSide; ++x) {
      padded[b * kBlockSide + x] = static_cast<std::int16_t>(lanes[x] & far);
    }
  }
  return true;
}

bool any_occupied(const TileSurroundings& around) {
  const auto side = static_cast<std::size_t>(kTileBlocks + 2 * around.halo);
  for (std::size_t z = 0; z < side; ++z) {
    for (std::size_t y = 0; y < side; ++y) {
      const VoxelMask* row = around.first + y * around.stride_y + z * around.stride_z;
      if (std::any_of(row, row + side, [](const VoxelMask& mask) { return mask.any(); })) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::vector<std::int16_t> tile_distance2(const TileSurroundings& around, int reach,
                                         TileScratch& scratch, SimdLevel simd) {
  const TileKernels& kernels = tile_kernels(simd);
  if (!any_occupied(around)) return {};
  const int pad = around.halo * kBlockSide;
  const auto wide = static_cast<std::size_t>(kTileSide + 2 * pad);
  const auto far = static_cast<std::int16_t>(reach * reach);
  scratch.x_pass.resize(wide * wide * kSide);
  scratch.x_row_used.resize(wide * wide);
  scratch.xy_pass.resize(wide * kSide * kSide);
  scratch.xy_row_used.resize(wide * kSide);
  std::vector<std::int16_t> padded(wide);
  for (std::size_t z = 0; z < wide; ++z) {
    for (std::size_t y = 0; y < wide; ++y) {
      const bool used = expand_row(around, static_cast<int>(y), static_cast<int>(z), far, padded);
      scratch.x_row_used[z * wide + y] = used;
      if (used)
        kernels.relax_row(padded.data(), pad, reach, far, &scratch.x_pass[(z * wide + y) * kSide]);
    }
    kernels.relax_rows(&scratch.x_pass[z * wide * kSide], &scratch.x_row_used[z * wide], 1, pad,
                       reach, far, &scratch.xy_pass[z * kSide * kSide],
                       &scratch.xy_row_used[z * kSide], 1);
  }
  std::vector<std::int16_t> tile(kSide * kSide * kSide);
  for (std::size_t y = 0; y < kSide; ++y) {
    kernels.relax_rows(&scratch.xy_pass[y * kSide], &scratch.xy_row_used[y], kSide, pad, reach, far,
                       &tile[y * kSide], nullptr, kSide);
  }
  return tile;
}

}  // namespace canopeer
