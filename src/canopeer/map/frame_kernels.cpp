#include "canopeer/map/frame_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>
#include <limits>

#include "canopeer/map/kernel_targets.h"

namespace canopeer {
namespace {

// Minimum and maximum as the vector instructions have them: no NaN comes here.
template <typename T>
CANOPEER_KERNEL_BODY T least(T a, T b) {
  return a < b ? a : b;
}
template <typename T>
CANOPEER_KERNEL_BODY T most(T a, T b) {
  return a > b ? a : b;
}

CANOPEER_KERNEL_BODY std::int32_t floor_of(double v) {
  const auto i = static_cast<std::int32_t>(v);
  return i - (v < static_cast<double>(i) ? 1 : 0);
}

constexpr double kLargest = std::numeric_limits<float>::max();

CANOPEER_KERNEL_BODY void end_points_from(const PixelRow& row, const PixelRowEnds& ends,
                                          std::size_t first) {
  const double no_return = row.clear_no_return ? 1.0 : 0.0;
  for (std::size_t u = first; u < row.width; ++u) {
    const double depth = static_cast<double>(row.depth[u]);
    const double limit = row.max_range_m / std::sqrt(row.along2 + row.across2[u]);
    const bool returned = depth > 0.0 && depth <= kLargest;
    const bool end = returned && depth <= limit;
    const double clear = returned ? limit : depth < 0.0 ? 0.0 : limit * no_return;
    const double d = end ? depth : 0.0;
    ends.free_depth[u] = static_cast<float>(end ? depth : clear);
    ends.is_end[u] = end ? 1 : 0;
    const auto voxel = [&](std::size_t axis, double across) {
      return floor_of((row.origin[axis] + d * (row.along[axis] + across)) / row.resolution_m);
    };
    ends.x[u] = voxel(0, row.across_x[u]);
    ends.y[u] = voxel(1, row.across_y[u]);
    ends.z[u] = voxel(2, row.across_z[u]);
  }
}

void end_point_row_scalar(const PixelRow& row, const PixelRowEnds& ends) {
  end_points_from(row, ends, 0);
}

CANOPEER_KERNEL_BODY void halve_min_body(const float* upper, const float* lower, std::size_t count,
                                         float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = least(least(upper[2 * i], upper[2 * i + 1]), least(lower[2 * i], lower[2 * i + 1]));
  }
}

CANOPEER_KERNEL_BODY void halve_max_body(const float* upper, const float* lower, std::size_t count,
                                         float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = most(most(upper[2 * i], upper[2 * i + 1]), most(lower[2 * i], lower[2 * i + 1]));
  }
}

CANOPEER_KERNEL_BODY void widen_min_body(const float* upper, const float* lower, std::size_t shift,
                                         std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = least(least(upper[i], upper[i + shift]), least(lower[i], lower[i + shift]));
  }
}

CANOPEER_KERNEL_BODY void widen_max_body(const float* upper, const float* lower, std::size_t shift,
                                         std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = most(most(upper[i], upper[i + shift]), most(lower[i], lower[i + shift]));
  }
}

// Bytes that are 0 or 1 to bits.
template <std::size_t kCount>
CANOPEER_KERNEL_BODY std::uint64_t pack_bits(const std::uint8_t* flags) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kCount / 8; ++i) {
    std::uint64_t bytes = 0;
    __builtin_memcpy(&bytes, flags + 8 * i, 8);
    bits |= (bytes * 0x0102040810204080U >> 56) << (8 * i);
  }
  return bits;
}

CANOPEER_KERNEL_BODY CubeViews classify_body(const FlatPyramid& pyramid, const CubeLanes& cubes) {
  constexpr float kNearest = 0.05F;  // nearer ones are not decided
  constexpr float kPixels = 0.25F;   // to spare, as voxels are projected in single precision
  constexpr float kMargin = 1e-5F;   // of depth, for the same reason: this + kShare · depth
  constexpr float kShare = 1e-6F;
  const auto width = static_cast<float>(pyramid.width);
  const auto height = static_cast<float>(pyramid.height);
  alignas(64) std::uint8_t none[CubeLanes::kMax] = {};
  alignas(64) std::uint8_t all[CubeLanes::kMax] = {};
  for (std::size_t i = 0; i < cubes.count; ++i) {
    const float x_low = cubes.x[i] - cubes.half[0], x_high = cubes.x[i] + cubes.half[0];
    const float y_low = cubes.y[i] - cubes.half[1], y_high = cubes.y[i] + cubes.half[1];
    const float z_low = cubes.z[i] - cubes.half[2], z_high = cubes.z[i] + cubes.half[2];
    const float margin = kMargin + kShare * most(z_high, 0.0F);
    const bool behind = (z_high <= 0.0F) | (z_low >= pyramid.largest + margin);
    const bool apart = z_low >= kNearest;
    // Bounds of x / z over the box.
    const float by_near = 1.0F / most(z_low, kNearest);
    const float by_far = 1.0F / most(z_high, kNearest);
    const float u_low =
        pyramid.fx * (x_low * (x_low < 0.0F ? by_near : by_far)) + pyramid.cx - kPixels;
    const float u_high =
        pyramid.fx * (x_high * (x_high < 0.0F ? by_far : by_near)) + pyramid.cx + kPixels;
    const float v_low =
        pyramid.fy * (y_low * (y_low < 0.0F ? by_near : by_far)) + pyramid.cy - kPixels;
    const float v_high =
        pyramid.fy * (y_high * (y_high < 0.0F ? by_far : by_near)) + pyramid.cy + kPixels;
    const bool outside = (u_high < 0.0F) | (v_high < 0.0F) | (u_low >= width) | (v_low >= height);
    const bool inside = (u_low >= 0.0F) & (v_low >= 0.0F) & (u_high < width) & (v_high < height);
    const auto u0 = static_cast<std::int32_t>(least(most(u_low, 0.0F), width - 1.0F));
    const auto v0 = static_cast<std::int32_t>(least(most(v_low, 0.0F), height - 1.0F));
    const auto u1 = static_cast<std::int32_t>(least(most(u_high, 0.0F), width - 1.0F));
    const auto v1 = static_cast<std::int32_t>(least(most(v_high, 0.0F), height - 1.0F));
    // The smallest windows of which two overlapping ones span the longer side, wherever they may
    // start: floor(log2(pixels + 1)), read off the exponent.
    const std::int32_t pixels = most(u1 - u0, v1 - v0) + 1;
    const std::int32_t wanted =
        (std::bit_cast<std::int32_t>(static_cast<float>(pixels + 1)) >> 23) - 127;
    const bool covered = wanted <= pyramid.top;
    const std::int32_t level = least(wanted, pyramid.top);
    const std::int32_t side = 1 << level;
    const std::int32_t column0 = u0 >> 1;
    const std::int32_t column1 = most(column0, (u1 - side + 2) >> 1);
    const std::int32_t offset = (level - 1) * pyramid.level_size;
    const std::int32_t row0 = offset + (v0 >> 1) * pyramid.wide;
    const std::int32_t row1 = offset + most(v0 >> 1, (v1 - side + 2) >> 1) * pyramid.wide;
    const float nearest = least(least(pyramid.min[row0 + column0], pyramid.min[row0 + column1]),
                                least(pyramid.min[row1 + column0], pyramid.min[row1 + column1]));
    const float farthest = most(most(pyramid.max[row0 + column0], pyramid.max[row0 + column1]),
                                most(pyramid.max[row1 + column0], pyramid.max[row1 + column1]));
    const bool none_free = behind | (apart & (outside | (covered & (z_low > farthest + margin))));
    none[i] = none_free ? 1 : 0;
    all[i] = ((none_free ^ true) & apart & inside & covered & (z_high < nearest - margin)) ? 1 : 0;
  }
  return {pack_bits<CubeLanes::kMax>(none), pack_bits<CubeLanes::kMax>(all)};
}

std::uint64_t seen_free_scalar(const FlatPyramid& camera, const VoxelLanes& voxels,
                               const SliceOffsets& offsets) {
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  std::uint64_t free = 0;
  for (std::size_t lane = 0; lane < 64; ++lane) {
    const std::size_t slice = lane / 16, i = lane % 16;
    const float depth = voxels.z[slice] + offsets.z[i];
    if (!(depth > 0.0F)) continue;
    const float inverse = 1.0F / depth;
    const float u = camera.fx * (voxels.x[slice] + offsets.x[i]) * inverse + camera.cx;
    const float v = camera.fy * (voxels.y[slice] + offsets.y[i]) * inverse + camera.cy;
    if (!(u >= 0.0F && u < width && v >= 0.0F && v < height)) continue;
    const std::int32_t pixel =
        static_cast<std::int32_t>(v) * camera.width + static_cast<std::int32_t>(u);
    free |= static_cast<std::uint64_t>(depth < camera.depth[pixel]) << lane;
  }
  return free;
}

#if defined(__x86_64__)

// The vector twins do the same operations in the same order, lane by lane.

CANOPEER_TARGET_AVX2 void end_point_row_avx2(const PixelRow& row, const PixelRowEnds& ends) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d one = _mm256_set1_pd(1.0);
  const __m256d no_return = _mm256_set1_pd(row.clear_no_return ? 1.0 : 0.0);
  const __m256d along2 = _mm256_set1_pd(row.along2);
  const __m256d max_range = _mm256_set1_pd(row.max_range_m);
  const __m256d resolution = _mm256_set1_pd(row.resolution_m);
  std::size_t u = 0;
  for (; u + 4 <= row.width; u += 4) {
    const __m256d depth = _mm256_cvtps_pd(_mm_loadu_ps(row.depth + u));
    const __m256d limit = _mm256_div_pd(
        max_range, _mm256_sqrt_pd(_mm256_add_pd(along2, _mm256_loadu_pd(row.across2 + u))));
    const __m256d returned =
        _mm256_and_pd(_mm256_cmp_pd(depth, zero, _CMP_GT_OQ),
                      _mm256_cmp_pd(depth, _mm256_set1_pd(kLargest), _CMP_LE_OQ));
    const __m256d end = _mm256_and_pd(returned, _mm256_cmp_pd(depth, limit, _CMP_LE_OQ));
    const __m256d masked = _mm256_cmp_pd(depth, zero, _CMP_LT_OQ);
    const __m256d clear = _mm256_andnot_pd(
        masked, _mm256_blendv_pd(_mm256_mul_pd(limit, no_return), limit, returned));
    const __m256d d = _mm256_and_pd(depth, end);
    _mm_storeu_ps(ends.free_depth + u, _mm256_cvtpd_ps(_mm256_blendv_pd(clear, depth, end)));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(ends.is_end + u),
                     _mm256_cvttpd_epi32(_mm256_and_pd(end, one)));
    const auto voxel = [&](std::size_t axis, const double* across,
                           std::int32_t* out) CANOPEER_TARGET_AVX2 {
      const __m256d direction =
          _mm256_add_pd(_mm256_set1_pd(row.along[axis]), _mm256_loadu_pd(across + u));
      const __m256d p = _mm256_div_pd(
          _mm256_add_pd(_mm256_set1_pd(row.origin[axis]), _mm256_mul_pd(d, direction)), resolution);
      const __m128i i = _mm256_cvttpd_epi32(p);
      const __m256d above = _mm256_cmp_pd(p, _mm256_cvtepi32_pd(i), _CMP_LT_OQ);
      const __m128i less = _mm256_cvttpd_epi32(_mm256_and_pd(above, one));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(out + u), _mm_sub_epi32(i, less));
    };
    voxel(0, row.across_x, ends.x);
    voxel(1, row.across_y, ends.y);
    voxel(2, row.across_z, ends.z);
  }
  end_points_from(row, ends, u);
}

CANOPEER_TARGET_AVX512 void end_point_row_avx512(const PixelRow& row, const PixelRowEnds& ends) {
  const __m512d no_return = _mm512_set1_pd(row.clear_no_return ? 1.0 : 0.0);
  const __m512d along2 = _mm512_set1_pd(row.along2);
  const __m512d max_range = _mm512_set1_pd(row.max_range_m);
  const __m512d resolution = _mm512_set1_pd(row.resolution_m);
  std::size_t u = 0;
  for (; u + 8 <= row.width; u += 8) {
    const __m512d depth = _mm512_cvtps_pd(_mm256_loadu_ps(row.depth + u));
    const __m512d limit = _mm512_div_pd(
        max_range, _mm512_sqrt_pd(_mm512_add_pd(along2, _mm512_loadu_pd(row.across2 + u))));
    const __mmask8 positive = _mm512_cmp_pd_mask(depth, _mm512_setzero_pd(), _CMP_GT_OQ);
    const __mmask8 returned =
        _mm512_mask_cmp_pd_mask(positive, depth, _mm512_set1_pd(kLargest), _CMP_LE_OQ);
    const __mmask8 end = _mm512_mask_cmp_pd_mask(returned, depth, limit, _CMP_LE_OQ);
    const __mmask8 not_masked = _mm512_cmp_pd_mask(depth, _mm512_setzero_pd(), _CMP_NLT_UQ);
    const __m512d clear = _mm512_maskz_mov_pd(
        not_masked, _mm512_mask_blend_pd(returned, _mm512_mul_pd(limit, no_return), limit));
    const __m512d d = _mm512_maskz_mov_pd(end, depth);
    _mm256_storeu_ps(ends.free_depth + u, _mm512_cvtpd_ps(_mm512_mask_blend_pd(end, clear, depth)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(ends.is_end + u),
                        _mm256_maskz_set1_epi32(end, 1));
    const auto voxel = [&](std::size_t axis, const double* across,
                           std::int32_t* out) CANOPEER_TARGET_AVX512 {
      const __m512d direction =
          _mm512_add_pd(_mm512_set1_pd(row.along[axis]), _mm512_loadu_pd(across + u));
      const __m512d p = _mm512_div_pd(
          _mm512_add_pd(_mm512_set1_pd(row.origin[axis]), _mm512_mul_pd(d, direction)), resolution);
      const __m256i i = _mm512_cvttpd_epi32(p);
      const __mmask8 above = _mm512_cmp_pd_mask(p, _mm512_cvtepi32_pd(i), _CMP_LT_OQ);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + u),
                          _mm256_mask_sub_epi32(i, above, i, _mm256_set1_epi32(1)));
    };
    voxel(0, row.across_x, ends.x);
    voxel(1, row.across_y, ends.y);
    voxel(2, row.across_z, ends.z);
  }
  end_points_from(row, ends, u);
}

CANOPEER_TARGET_AVX2 std::uint64_t seen_free_avx2(const FlatPyramid& camera,
                                                  const VoxelLanes& voxels,
                                                  const SliceOffsets& offsets) {
  const __m256 zero = _mm256_setzero_ps();
  const __m256 one = _mm256_set1_ps(1.0F);
  const __m256 fx = _mm256_set1_ps(camera.fx), fy = _mm256_set1_ps(camera.fy);
  const __m256 cx = _mm256_set1_ps(camera.cx), cy = _mm256_set1_ps(camera.cy);
  const __m256 width = _mm256_set1_ps(static_cast<float>(camera.width));
  const __m256 height = _mm256_set1_ps(static_cast<float>(camera.height));
  const __m256i row = _mm256_set1_epi32(camera.width);
  std::uint64_t free = 0;
  for (std::size_t part = 0; part < 8; ++part) {
    const std::size_t slice = part / 2, i = part % 2 * 8;
    const __m256 depth =
        _mm256_add_ps(_mm256_set1_ps(voxels.z[slice]), _mm256_load_ps(&offsets.z[i]));
    const __m256 before = _mm256_cmp_ps(depth, zero, _CMP_GT_OQ);
    const __m256 inverse = _mm256_div_ps(one, _mm256_blendv_ps(one, depth, before));
    const __m256 x = _mm256_add_ps(_mm256_set1_ps(voxels.x[slice]), _mm256_load_ps(&offsets.x[i]));
    const __m256 y = _mm256_add_ps(_mm256_set1_ps(voxels.y[slice]), _mm256_load_ps(&offsets.y[i]));
    const __m256 u = _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(fx, x), inverse), cx);
    const __m256 v = _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(fy, y), inverse), cy);
    const __m256 across =
        _mm256_and_ps(_mm256_cmp_ps(u, zero, _CMP_GE_OQ), _mm256_cmp_ps(u, width, _CMP_LT_OQ));
    const __m256 along =
        _mm256_and_ps(_mm256_cmp_ps(v, zero, _CMP_GE_OQ), _mm256_cmp_ps(v, height, _CMP_LT_OQ));
    const __m256 seen = _mm256_and_ps(before, _mm256_and_ps(across, along));
    const __m256i pixel =
        _mm256_add_epi32(_mm256_mullo_epi32(_mm256_cvttps_epi32(_mm256_and_ps(v, seen)), row),
                         _mm256_cvttps_epi32(_mm256_and_ps(u, seen)));
    const __m256 surface = _mm256_mask_i32gather_ps(zero, camera.depth, pixel, seen, 4);
    const __m256 is_free = _mm256_and_ps(seen, _mm256_cmp_ps(depth, surface, _CMP_LT_OQ));
    const auto bits = static_cast<unsigned>(_mm256_movemask_ps(is_free));
    free |= std::uint64_t{bits} << (8 * part);
  }
  return free;
}

CANOPEER_TARGET_AVX512 std::uint64_t seen_free_avx512(const FlatPyramid& camera,
                                                      const VoxelLanes& voxels,
                                                      const SliceOffsets& offsets) {
  const __m512 zero = _mm512_setzero_ps();
  const __m512 one = _mm512_set1_ps(1.0F);
  const __m512 fx = _mm512_set1_ps(camera.fx), fy = _mm512_set1_ps(camera.fy);
  const __m512 cx = _mm512_set1_ps(camera.cx), cy = _mm512_set1_ps(camera.cy);
  const __m512 width = _mm512_set1_ps(static_cast<float>(camera.width));
  const __m512 height = _mm512_set1_ps(static_cast<float>(camera.height));
  const __m512i row = _mm512_set1_epi32(camera.width);
  std::uint64_t free = 0;
  for (std::size_t slice = 0; slice < 4; ++slice) {
    const __m512 depth =
        _mm512_add_ps(_mm512_set1_ps(voxels.z[slice]), _mm512_load_ps(&offsets.z[0]));
    const __mmask16 before = _mm512_cmp_ps_mask(depth, zero, _CMP_GT_OQ);
    const __m512 inverse = _mm512_div_ps(one, _mm512_mask_blend_ps(before, one, depth));
    const __m512 x = _mm512_add_ps(_mm512_set1_ps(voxels.x[slice]), _mm512_load_ps(&offsets.x[0]));
    const __m512 y = _mm512_add_ps(_mm512_set1_ps(voxels.y[slice]), _mm512_load_ps(&offsets.y[0]));
    const __m512 u = _mm512_add_ps(_mm512_mul_ps(_mm512_mul_ps(fx, x), inverse), cx);
    const __m512 v = _mm512_add_ps(_mm512_mul_ps(_mm512_mul_ps(fy, y), inverse), cy);
    const __mmask16 across = _mm512_mask_cmp_ps_mask(
        _mm512_mask_cmp_ps_mask(before, u, zero, _CMP_GE_OQ), u, width, _CMP_LT_OQ);
    const __mmask16 seen = _mm512_mask_cmp_ps_mask(
        _mm512_mask_cmp_ps_mask(across, v, zero, _CMP_GE_OQ), v, height, _CMP_LT_OQ);
    const __m512i pixel =
        _mm512_add_epi32(_mm512_mullo_epi32(_mm512_maskz_cvttps_epi32(seen, v), row),
                         _mm512_maskz_cvttps_epi32(seen, u));
    const __m512 surface = _mm512_mask_i32gather_ps(zero, seen, pixel, camera.depth, 4);
    const __mmask16 is_free = _mm512_mask_cmp_ps_mask(seen, depth, surface, _CMP_LT_OQ);
    free |= std::uint64_t{is_free} << (16 * slice);
  }
  return free;
}

#endif

// The others are written once and inlined into one function per instruction set.
#define CANOPEER_KERNELS(NAME, TARGET)                                                    \
  TARGET void halve_min_##NAME(const float* upper, const float* lower, std::size_t count, \
                               float* out) {                                              \
    halve_min_body(upper, lower, count, out);                                             \
  }                                                                                       \
  TARGET void halve_max_##NAME(const float* upper, const float* lower, std::size_t count, \
                               float* out) {                                              \
    halve_max_body(upper, lower, count, out);                                             \
  }                                                                                       \
  TARGET void widen_min_##NAME(const float* upper, const float* lower, std::size_t shift, \
                               std::size_t count, float* out) {                           \
    widen_min_body(upper, lower, shift, count, out);                                      \
  }                                                                                       \
  TARGET void widen_max_##NAME(const float* upper, const float* lower, std::size_t shift, \
                               std::size_t count, float* out) {                           \
    widen_max_body(upper, lower, shift, count, out);                                      \
  }                                                                                       \
  TARGET CubeViews classify_##NAME(const FlatPyramid& pyramid, const CubeLanes& cubes) {  \
    return classify_body(pyramid, cubes);                                                 \
  }                                                                                       \
  constexpr FrameKernels kKernels_##NAME = {                                              \
      end_point_row_##NAME, halve_min_##NAME, halve_max_##NAME, widen_min_##NAME,         \
      widen_max_##NAME,     classify_##NAME,  seen_free_##NAME};

CANOPEER_KERNELS(scalar, )
#if defined(__x86_64__)
CANOPEER_KERNELS(avx2, CANOPEER_TARGET_AVX2)
CANOPEER_KERNELS(avx512, CANOPEER_TARGET_AVX512)
#endif

}  // namespace

const FrameKernels& frame_kernels([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kKernels_avx512;
  if (level == SimdLevel::avx2) return kKernels_avx2;
#endif
  return kKernels_scalar;
}

}  // namespace canopeer
