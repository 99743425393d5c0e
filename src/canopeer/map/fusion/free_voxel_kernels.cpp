#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cstring>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/map/fusion/frame_kernel_parts.h"
#include "canopeer/map/fusion/free_voxel_parts.h"
#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

// Where the first voxels of each slice of a half block are, camera frame; four slices follow.
struct HalfBlock {
  const float* x;
  const float* y;
  const float* z;
};

// Per voxel of a half block: how deep it lies, and the pixel its centre falls on (pixel 0 when it
// is not seen).
struct Projected {
  float* depth;
  std::int32_t* pixel;
};

// Bit slice · 16 + i: the voxel is in the image.
using Project = std::uint64_t (*)(const FlatPyramid&, const BlockProjection&, const HalfBlock&,
                                  const Projected&);
// Bit i: depth[i] < surface[i].
using Nearer = std::uint64_t (*)(const float* depth, const float* surface);

std::uint64_t project_scalar(const FlatPyramid& camera, const BlockProjection& offsets,
                             const HalfBlock& half, const Projected& out) {
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  std::uint64_t seen = 0;
  for (std::size_t lane = 0; lane < kHalfVoxels; ++lane) {
    const std::size_t slice = lane / 16, i = lane % 16;
    const float depth = half.z[slice] + offsets.z[i];
    out.depth[lane] = depth;
    out.pixel[lane] = 0;
    if (!(depth > 0.0F)) continue;
    const float inverse = 1.0F / depth;
    const float u = camera.fx * (half.x[slice] + offsets.x[i]) * inverse + camera.cx;
    const float v = camera.fy * (half.y[slice] + offsets.y[i]) * inverse + camera.cy;
    if (!(u >= 0.0F && u < width && v >= 0.0F && v < height)) continue;
    out.pixel[lane] = static_cast<std::int32_t>(v) * camera.width + static_cast<std::int32_t>(u);
    seen |= std::uint64_t{1} << lane;
  }
  return seen;
}

std::uint64_t nearer_scalar(const float* depth, const float* surface) {
  std::uint64_t nearer = 0;
  for (std::size_t i = 0; i < kHalfVoxels; ++i) {
    nearer |= static_cast<std::uint64_t>(depth[i] < surface[i]) << i;
  }
  return nearer;
}

// The vector twins do the same operations in the same order, lane by lane.

std::uint64_t project_narrow(const FlatPyramid& camera, const BlockProjection& offsets,
                             const HalfBlock& half, const Projected& out) {
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  const FourFloats zero{}, one = all_lanes<FourFloats>(1.0F);
  std::uint64_t seen = 0;
  for (std::size_t lane = 0; lane < kHalfVoxels; lane += 4) {
    const std::size_t slice = lane / 16, i = lane % 16;
    const FourFloats depth = half.z[slice] + load_lanes<FourFloats>(&offsets.z[i]);
    const FourBits before = depth > zero;
    const FourFloats inverse = one / (before ? depth : one);
    const FourFloats x = half.x[slice] + load_lanes<FourFloats>(&offsets.x[i]);
    const FourFloats y = half.y[slice] + load_lanes<FourFloats>(&offsets.y[i]);
    const FourFloats u = camera.fx * x * inverse + camera.cx;
    const FourFloats v = camera.fy * y * inverse + camera.cy;
    const FourBits in_image = before & (u >= zero) & (u < width) & (v >= zero) & (v < height);
    const FourBits rows = __builtin_convertvector(in_image ? v : zero, FourBits) * camera.width;
    const FourBits columns = __builtin_convertvector(in_image ? u : zero, FourBits);
    store_lanes(depth, out.depth + lane);
    store_lanes(rows + columns, out.pixel + lane);
    seen |= std::uint64_t{lane_bits(in_image)} << lane;
  }
  return seen;
}

std::uint64_t nearer_narrow(const float* depth, const float* surface) {
  std::uint64_t nearer = 0;
  for (std::size_t i = 0; i < kHalfVoxels; i += 4) {
    const FourBits lanes = load_lanes<FourFloats>(depth + i) < load_lanes<FourFloats>(surface + i);
    nearer |= std::uint64_t{lane_bits(lanes)} << i;
  }
  return nearer;
}

#if defined(__x86_64__)

CANOPEER_TARGET_AVX2 std::uint64_t project_avx2(const FlatPyramid& camera,
                                                const BlockProjection& offsets,
                                                const HalfBlock& half, const Projected& out) {
  const __m256 zero = _mm256_setzero_ps();
  const __m256 one = _mm256_set1_ps(1.0F);
  const __m256 fx = _mm256_set1_ps(camera.fx), fy = _mm256_set1_ps(camera.fy);
  const __m256 cx = _mm256_set1_ps(camera.cx), cy = _mm256_set1_ps(camera.cy);
  const __m256 width = _mm256_set1_ps(static_cast<float>(camera.width));
  const __m256 height = _mm256_set1_ps(static_cast<float>(camera.height));
  const __m256i row = _mm256_set1_epi32(camera.width);
  std::uint64_t seen = 0;
  for (std::size_t part = 0; part < 8; ++part) {
    const std::size_t slice = part / 2, i = part % 2 * 8;
    const __m256 depth =
        _mm256_add_ps(_mm256_set1_ps(half.z[slice]), _mm256_load_ps(&offsets.z[i]));
    const __m256 before = _mm256_cmp_ps(depth, zero, _CMP_GT_OQ);
    const __m256 inverse = _mm256_div_ps(one, _mm256_blendv_ps(one, depth, before));
    const __m256 x = _mm256_add_ps(_mm256_set1_ps(half.x[slice]), _mm256_load_ps(&offsets.x[i]));
    const __m256 y = _mm256_add_ps(_mm256_set1_ps(half.y[slice]), _mm256_load_ps(&offsets.y[i]));
    const __m256 u = _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(fx, x), inverse), cx);
    const __m256 v = _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(fy, y), inverse), cy);
    const __m256 across =
        _mm256_and_ps(_mm256_cmp_ps(u, zero, _CMP_GE_OQ), _mm256_cmp_ps(u, width, _CMP_LT_OQ));
    const __m256 along =
        _mm256_and_ps(_mm256_cmp_ps(v, zero, _CMP_GE_OQ), _mm256_cmp_ps(v, height, _CMP_LT_OQ));
    const __m256 in_image = _mm256_and_ps(before, _mm256_and_ps(across, along));
    const __m256i rows = _mm256_mullo_epi32(_mm256_cvttps_epi32(_mm256_and_ps(v, in_image)), row);
    const __m256i columns = _mm256_cvttps_epi32(_mm256_and_ps(u, in_image));
    _mm256_store_ps(out.depth + 8 * part, depth);
    _mm256_store_si256(reinterpret_cast<__m256i*>(out.pixel + 8 * part),
                       _mm256_add_epi32(rows, columns));
    const auto bits = static_cast<unsigned>(_mm256_movemask_ps(in_image));
    seen |= std::uint64_t{bits} << (8 * part);
  }
  return seen;
}

CANOPEER_TARGET_AVX2 std::uint64_t nearer_avx2(const float* depth, const float* surface) {
  std::uint64_t nearer = 0;
  for (std::size_t i = 0; i < kHalfVoxels; i += 8) {
    const auto bits = static_cast<unsigned>(_mm256_movemask_ps(
        _mm256_cmp_ps(_mm256_load_ps(depth + i), _mm256_load_ps(surface + i), _CMP_LT_OQ)));
    nearer |= std::uint64_t{bits} << i;
  }
  return nearer;
}

#endif

// surface[i] = depth[pixel[i]] for `count` pixels, a multiple of 8.
CANOPEER_ONE_BY_ONE void look_up_depths(const float* depth, const std::int32_t* pixel,
                                        std::size_t count, float* surface) {
  // As integers: a vector register written in part would wait for its other part.
  for (std::size_t i = 0; i < count; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) {
      std::uint32_t bits;
      std::memcpy(&bits, depth + pixel[i + k], sizeof bits);
      std::memcpy(surface + i + k, &bits, sizeof bits);
    }
  }
}

// The bits of the eight half blocks to where a block's mask has them.
CANOPEER_KERNEL_BODY VoxelMask join_halves(const std::uint64_t* halves) {
  alignas(64) static constexpr std::uint64_t kShift[8] = {0, 4, 32, 36, 0, 4, 32, 36};
  VoxelMask mask;
  for (unsigned k = 0; k < kHalf; ++k) {
    alignas(64) std::uint64_t spread[8];
    for (unsigned i = 0; i < 8; ++i) {
      // Rows of 4 bits to the 8 a mask has.
      const std::uint64_t rows = halves[i] >> (16 * k);
      spread[i] = ((rows & 0xF) | (rows & 0xF0) << 4 | (rows & 0xF00) << 8 | (rows & 0xF000) << 12)
                  << kShift[i];
    }
    mask.slices[k] = spread[0] | spread[1] | spread[2] | spread[3];
    mask.slices[k + kHalf] = spread[4] | spread[5] | spread[6] | spread[7];
  }
  return mask;
}

// Three passes over the halves to be looked at, so that none waits for what the one before stored.
CANOPEER_KERNEL_BODY VoxelMask free_in_block_body(const FlatPyramid& camera,
                                                  const BlockProjection& projection,
                                                  const std::array<int, 3>& corner,
                                                  const HalfBlocks& halves, Project project,
                                                  Nearer nearer) {
  alignas(64) FirstCentres first;
  find_first_centres(projection, corner, first);
  alignas(64) float depth[kBlockVoxels];
  alignas(64) float surface[kBlockVoxels];
  alignas(64) std::int32_t pixel[kBlockVoxels];
  alignas(64) std::uint64_t free[8];
  unsigned looked_at[8];
  std::uint64_t seen[8];
  std::size_t count = 0;
  for (unsigned i = 0; i < 8; ++i) {
    free[i] = (halves.all_free() >> i & 1) != 0 ? ~std::uint64_t{0} : 0;
    if ((halves.undecided() >> i & 1) == 0) continue;
    const auto& at = first[i & 3];
    const unsigned slice = i >> 2 ? kHalf : 0;
    seen[count] = project(camera, projection, {at[0] + slice, at[1] + slice, at[2] + slice},
                          {depth + count * kHalfVoxels, pixel + count * kHalfVoxels});
    looked_at[count] = i;
    count += seen[count] != 0;
  }
  look_up_depths(camera.depth, pixel, count * kHalfVoxels, surface);
  for (std::size_t i = 0; i < count; ++i) {
    free[looked_at[i]] = nearer(depth + i * kHalfVoxels, surface + i * kHalfVoxels) & seen[i];
  }
  return join_halves(free);
}

#define CANOPEER_KERNELS(NAME, TARGET)                                                            \
  TARGET VoxelMask free_in_block_##NAME(                                                          \
      const FlatPyramid& camera, const BlockProjection& projection,                               \
      const std::array<int, 3>& corner, const HalfBlocks& halves) {                               \
    return free_in_block_body(camera, projection, corner, halves, project_##NAME, nearer_##NAME); \
  }

CANOPEER_KERNELS(scalar, )
CANOPEER_KERNELS(narrow, )
#if defined(__x86_64__)
CANOPEER_KERNELS(avx2, CANOPEER_TARGET_AVX2)
#endif

}  // namespace

FreeInBlockKernel free_in_block_kernel([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_EACH_LEVEL(level, free_in_block);
}

}  // namespace canopeer
