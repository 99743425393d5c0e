#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cmath>
#include <limits>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/map/fusion/frame_kernel_parts.h"
#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

CANOPEER_KERNEL_BODY std::int32_t floor_of(double v) {
  const auto i = static_cast<std::int32_t>(v);
  return i - (v < static_cast<double>(i) ? 1 : 0);
}

constexpr double kLargest = std::numeric_limits<float>::max();
// Products in place of quotients and roots, where rounding cannot change what comes out: squared
// ranges this much below the limit's are within it; voxel coordinates (below 2^24, so good to
// 2^-28) this far from an integer have the floor the quotient has.
constexpr double kSurelyWithin = 1.0 - 1e-9;
constexpr double kSurelyInside = 0x1p-20;

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

// The vector twins do the same operations in the same order, lane by lane.

using TwoDoubles = double __attribute__((vector_size(16)));
using TwoLongs = std::int64_t __attribute__((vector_size(16)));
using TwoFloats = float __attribute__((vector_size(8)));
using TwoInts = std::int32_t __attribute__((vector_size(8)));

void end_point_row_narrow(const PixelRow& row, const PixelRowEnds& ends) {
  const auto root = [](TwoDoubles x) { return TwoDoubles{std::sqrt(x[0]), std::sqrt(x[1])}; };
  const TwoDoubles zero{};
  const double no_return = row.clear_no_return ? 1.0 : 0.0;
  std::size_t u = 0;
  for (; u + 2 <= row.width; u += 2) {
    const auto two = [u](const double* from) { return load_lanes<TwoDoubles>(from + u); };
    const auto depth = __builtin_convertvector(load_lanes<TwoFloats>(row.depth + u), TwoDoubles);
    const TwoDoubles limit = row.max_range_m / root(row.along2 + two(row.across2));
    const auto returned = (depth > zero) & (depth <= kLargest);
    const auto end = returned & (depth <= limit);
    const TwoDoubles beyond = depth < zero ? zero : limit * no_return;
    const TwoDoubles clear = returned ? limit : beyond;
    const TwoDoubles d = end ? depth : zero;
    const TwoDoubles free_depth = end ? depth : clear;
    store_lanes(__builtin_convertvector(free_depth, TwoFloats), ends.free_depth + u);
    store_lanes(-__builtin_convertvector(end, TwoInts), ends.is_end + u);
    const auto voxel = [&](std::size_t axis, const double* across, std::int32_t* out) {
      const TwoDoubles v =
          (row.origin[axis] + d * (row.along[axis] + two(across))) / row.resolution_m;
      const TwoDoubles whole = {std::floor(v[0]), std::floor(v[1])};
      store_lanes(__builtin_convertvector(__builtin_convertvector(whole, TwoLongs), TwoInts),
                  out + u);
    };
    voxel(0, row.across_x, ends.x);
    voxel(1, row.across_y, ends.y);
    voxel(2, row.across_z, ends.z);
  }
  end_points_from(row, ends, u);
}

#if defined(__x86_64__)

CANOPEER_TARGET_AVX2 void end_point_row_avx2(const PixelRow& row, const PixelRowEnds& ends) {
  const __m256d zero = _mm256_setzero_pd();
  const __m256d one = _mm256_set1_pd(1.0);
  const __m256d no_return = _mm256_set1_pd(row.clear_no_return ? 1.0 : 0.0);
  const __m256d along2 = _mm256_set1_pd(row.along2);
  const __m256d max_range = _mm256_set1_pd(row.max_range_m);
  const __m256d within2 = _mm256_set1_pd(row.max_range_m * row.max_range_m * kSurelyWithin);
  const __m256d resolution = _mm256_set1_pd(row.resolution_m);
  const __m256d inverse = _mm256_set1_pd(1.0 / row.resolution_m);
  const __m256d least = _mm256_set1_pd(kSurelyInside), most = _mm256_set1_pd(1.0 - kSurelyInside);
  std::size_t u = 0;
  for (; u + 4 <= row.width; u += 4) {
    const __m256d depth = _mm256_cvtps_pd(_mm_loadu_ps(row.depth + u));
    const __m256d slant2 = _mm256_add_pd(along2, _mm256_loadu_pd(row.across2 + u));
    const __m256d returned =
        _mm256_and_pd(_mm256_cmp_pd(depth, zero, _CMP_GT_OQ),
                      _mm256_cmp_pd(depth, _mm256_set1_pd(kLargest), _CMP_LE_OQ));
    const __m256d range2 = _mm256_mul_pd(_mm256_mul_pd(depth, depth), slant2);
    const __m256d surely = _mm256_and_pd(returned, _mm256_cmp_pd(range2, within2, _CMP_LE_OQ));
    __m256d end = surely;
    __m256d clear = zero;
    if (row.clear_no_return || _mm256_movemask_pd(surely) != _mm256_movemask_pd(returned)) {
      const __m256d limit = _mm256_div_pd(max_range, _mm256_sqrt_pd(slant2));
      end = _mm256_and_pd(returned, _mm256_cmp_pd(depth, limit, _CMP_LE_OQ));
      const __m256d masked = _mm256_cmp_pd(depth, zero, _CMP_LT_OQ);
      clear = _mm256_andnot_pd(masked,
                               _mm256_blendv_pd(_mm256_mul_pd(limit, no_return), limit, returned));
    }
    const __m256d d = _mm256_and_pd(depth, end);
    _mm_storeu_ps(ends.free_depth + u, _mm256_cvtpd_ps(_mm256_blendv_pd(clear, depth, end)));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(ends.is_end + u),
                     _mm256_cvttpd_epi32(_mm256_and_pd(end, one)));
    const auto voxel = [&](std::size_t axis, const double* across,
                           std::int32_t* out) CANOPEER_TARGET_AVX2 {
      const __m256d direction =
          _mm256_add_pd(_mm256_set1_pd(row.along[axis]), _mm256_loadu_pd(across + u));
      const __m256d at =
          _mm256_add_pd(_mm256_set1_pd(row.origin[axis]), _mm256_mul_pd(d, direction));
      const __m256d p = _mm256_mul_pd(at, inverse);
      __m256d floor = _mm256_floor_pd(p);
      const __m256d rest = _mm256_sub_pd(p, floor);
      if (_mm256_movemask_pd(_mm256_or_pd(_mm256_cmp_pd(rest, least, _CMP_LT_OQ),
                                          _mm256_cmp_pd(rest, most, _CMP_GT_OQ))) != 0) {
        floor = _mm256_floor_pd(_mm256_div_pd(at, resolution));
      }
      _mm_storeu_si128(reinterpret_cast<__m128i*>(out + u), _mm256_cvttpd_epi32(floor));
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
  const __m512d within2 = _mm512_set1_pd(row.max_range_m * row.max_range_m * kSurelyWithin);
  const __m512d resolution = _mm512_set1_pd(row.resolution_m);
  const __m512d inverse = _mm512_set1_pd(1.0 / row.resolution_m);
  const __m512d least = _mm512_set1_pd(kSurelyInside), most = _mm512_set1_pd(1.0 - kSurelyInside);
  constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
  std::size_t u = 0;
  for (; u + 8 <= row.width; u += 8) {
    const __m512d depth = _mm512_cvtps_pd(_mm256_loadu_ps(row.depth + u));
    const __m512d slant2 = _mm512_add_pd(along2, _mm512_loadu_pd(row.across2 + u));
    const __mmask8 positive = _mm512_cmp_pd_mask(depth, _mm512_setzero_pd(), _CMP_GT_OQ);
    const __mmask8 returned =
        _mm512_mask_cmp_pd_mask(positive, depth, _mm512_set1_pd(kLargest), _CMP_LE_OQ);
    const __m512d range2 = _mm512_mul_pd(_mm512_mul_pd(depth, depth), slant2);
    __mmask8 end = _mm512_mask_cmp_pd_mask(returned, range2, within2, _CMP_LE_OQ);
    __m512d clear = _mm512_setzero_pd();
    if (row.clear_no_return || end != returned) {
      const __m512d limit = _mm512_div_pd(max_range, _mm512_sqrt_pd(slant2));
      end = _mm512_mask_cmp_pd_mask(returned, depth, limit, _CMP_LE_OQ);
      const __mmask8 not_masked = _mm512_cmp_pd_mask(depth, _mm512_setzero_pd(), _CMP_NLT_UQ);
      clear = _mm512_maskz_mov_pd(
          not_masked, _mm512_mask_blend_pd(returned, _mm512_mul_pd(limit, no_return), limit));
    }
    const __m512d d = _mm512_maskz_mov_pd(end, depth);
    _mm256_storeu_ps(ends.free_depth + u, _mm512_cvtpd_ps(_mm512_mask_blend_pd(end, clear, depth)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(ends.is_end + u),
                        _mm256_maskz_set1_epi32(end, 1));
    const auto voxel = [&](std::size_t axis, const double* across,
                           std::int32_t* out) CANOPEER_TARGET_AVX512 {
      const __m512d direction =
          _mm512_add_pd(_mm512_set1_pd(row.along[axis]), _mm512_loadu_pd(across + u));
      const __m512d at =
          _mm512_add_pd(_mm512_set1_pd(row.origin[axis]), _mm512_mul_pd(d, direction));
      const __m512d p = _mm512_mul_pd(at, inverse);
      __m512d floor = _mm512_roundscale_pd(p, kDown);
      const __m512d rest = _mm512_sub_pd(p, floor);
      if ((_mm512_cmp_pd_mask(rest, least, _CMP_LT_OQ) |
           _mm512_cmp_pd_mask(rest, most, _CMP_GT_OQ)) != 0) {
        floor = _mm512_roundscale_pd(_mm512_div_pd(at, resolution), kDown);
      }
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + u), _mm512_cvttpd_epi32(floor));
    };
    voxel(0, row.across_x, ends.x);
    voxel(1, row.across_y, ends.y);
    voxel(2, row.across_z, ends.z);
  }
  end_points_from(row, ends, u);
}

#endif

}  // namespace

EndPointRowKernel end_point_row_kernel([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_EACH_LEVEL(level, end_point_row);
}

}  // namespace canopeer
