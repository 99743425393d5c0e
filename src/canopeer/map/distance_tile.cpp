#include "canopeer/map/distance_tile.h"

#include <algorithm>
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

// out[j] = min over |k| ≤ reach of rows[(j + k) · stride] + gap²(k), for `count` rows that are
// `stride` rows apart; rows without a mark hold nothing nearer than `far`.
CANOPEER_KERNEL_BODY void relax_rows_body(const std::int16_t* rows, const std::uint8_t* used,
                                          std::size_t stride, int pad, int reach, std::int16_t far,
                                          std::int16_t* out, std::uint8_t* out_used,
                                          std::size_t out_stride) {
  for (std::size_t j = 0; j < kSide; ++j) {
    TileRow best = TileRow{} + far;
    std::uint8_t any = 0;
    for (int k = -reach; k <= reach; ++k) {
      const std::size_t row = (j + static_cast<std::size_t>(pad + k)) * stride;
      if (used[row] == 0) continue;
      any = 1;
      CANOPEER_RELAX(best, rows + row * kSide, gap2(k));
    }
    std::memcpy(out + j * out_stride * kSide, &best, sizeof best);
    if (out_used != nullptr) out_used[j * out_stride] = any;
  }
}

CANOPEER_KERNEL_BODY void relax_row_body(const std::int16_t* padded, int pad, int reach,
                                         std::int16_t far, std::int16_t* out) {
  TileRow best = TileRow{} + far;
  for (int k = -reach; k <= reach; ++k) CANOPEER_RELAX(best, padded + (pad + k), gap2(k));
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
    const unsigned bits = row_bits(b);
    for (unsigned x = 0; x < kBlockSide; ++x) {
      padded[b * kBlockSide + x] = (bits >> x & 1U) != 0 ? std::int16_t{0} : far;
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
