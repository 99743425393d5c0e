#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <cstring>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/map/fusion/frame_kernel_parts.h"
#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

CANOPEER_KERNEL_BODY std::int32_t label_of(const LabelledRow& row, std::size_t u) {
  if (row.ends.is_end[u] == 0) return 0;
  return 1 + (row.mask == nullptr ? 0 : std::min(row.mask[u], row.most));
}

CANOPEER_KERNEL_BODY void first_pixels_from(const LabelledRow& row, std::size_t start,
                                            std::uint64_t* first) {
  const auto alike = [&](std::size_t u, const PixelRowEnds& other, const std::int32_t* labels,
                         std::size_t at) {
    return row.label[u] == labels[at] && row.ends.x[u] == other.x[at] &&
           row.ends.y[u] == other.y[at] && row.ends.z[u] == other.z[at];
  };
  for (std::size_t u = start; u < row.width; ++u) {
    row.label[u] = label_of(row, u);
    if (row.label[u] == 0 || alike(u, row.above, row.label_above, u)) continue;
    if (u > 0 && alike(u, row.ends, row.label, u - 1)) continue;
    first[u / 64] |= std::uint64_t{1} << u % 64;
  }
}

void first_pixels_scalar(const LabelledRow& row, std::uint64_t* first) {
  std::fill_n(first, (row.width + 63) / 64, std::uint64_t{0});
  first_pixels_from(row, 0, first);
}

void first_pixels_narrow(const LabelledRow& row, std::uint64_t* first) {
  std::fill_n(first, (row.width + 63) / 64, std::uint64_t{0});
  const FourBits most = all_lanes<FourBits>(std::int32_t{row.most});
  FourBits before[4] = {};
  std::size_t u = 0;
  for (; u + 4 <= row.width; u += 4) {
    const auto load = [u](const std::int32_t* from) { return load_lanes<FourBits>(from + u); };
    FourBits label = load(row.ends.is_end);
    const FourBits is_end = -label;
    if (row.mask != nullptr) {
      const FourBits value = {row.mask[u], row.mask[u + 1], row.mask[u + 2], row.mask[u + 3]};
      label += is_end & (value < most ? value : most);
    }
    store_lanes(label, row.label + u);
    const FourBits now[4] = {label, load(row.ends.x), load(row.ends.y), load(row.ends.z)};
    const std::int32_t* above[4] = {row.label_above, row.above.x, row.above.y, row.above.z};
    FourBits as_left = is_end, as_above = is_end;
    for (int i = 0; i < 4; ++i) {
      as_left &= now[i] == __builtin_shufflevector(before[i], now[i], 3, 4, 5, 6);
      as_above &= now[i] == load(above[i]);
      before[i] = now[i];
    }
    first[u / 64] |= std::uint64_t{lane_bits(is_end & ~(as_left | as_above))} << u % 64;
  }
  first_pixels_from(row, u, first);
}

#if defined(__x86_64__)

CANOPEER_TARGET_AVX2 void first_pixels_avx2(const LabelledRow& row, std::uint64_t* first) {
  std::fill_n(first, (row.width + 63) / 64, std::uint64_t{0});
  const __m256i most = _mm256_set1_epi32(row.most);
  const __m256i last_lane = _mm256_setr_epi32(7, 0, 1, 2, 3, 4, 5, 6);
  // What lies left of the lanes: they move up by one, the last of those before comes in.
  __m256i before[4] = {};
  std::size_t u = 0;
  for (; u + 8 <= row.width; u += 8) {
    const auto load = [u](const std::int32_t* from) CANOPEER_TARGET_AVX2 {
      return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + u));
    };
    __m256i label = load(row.ends.is_end);
    const __m256i is_end = _mm256_sub_epi32(_mm256_setzero_si256(), label);
    if (row.mask != nullptr) {
      const __m256i value =
          _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row.mask + u)));
      label = _mm256_add_epi32(label, _mm256_and_si256(is_end, _mm256_min_epi32(value, most)));
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(row.label + u), label);
    const __m256i now[4] = {label, load(row.ends.x), load(row.ends.y), load(row.ends.z)};
    const std::int32_t* above[4] = {row.label_above, row.above.x, row.above.y, row.above.z};
    __m256i as_left = is_end, as_above = is_end;
    for (int i = 0; i < 4; ++i) {
      const __m256i moved = _mm256_permutevar8x32_epi32(now[i], last_lane);
      const __m256i left = _mm256_blend_epi32(moved, before[i], 1);
      as_left = _mm256_and_si256(as_left, _mm256_cmpeq_epi32(now[i], left));
      as_above = _mm256_and_si256(as_above, _mm256_cmpeq_epi32(now[i], load(above[i])));
      before[i] = moved;
    }
    const __m256i fresh = _mm256_andnot_si256(_mm256_or_si256(as_left, as_above), is_end);
    const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(fresh)));
    first[u / 64] |= std::uint64_t{bits} << u % 64;
  }
  first_pixels_from(row, u, first);
}

CANOPEER_TARGET_AVX512 void first_pixels_avx512(const LabelledRow& row, std::uint64_t* first) {
  std::fill_n(first, (row.width + 63) / 64, std::uint64_t{0});
  const __m512i most = _mm512_set1_epi32(row.most);
  __m512i label_before = _mm512_setzero_si512(), x_before = label_before;
  __m512i y_before = label_before, z_before = label_before;
  std::size_t u = 0;
  for (; u + 16 <= row.width; u += 16) {
    __m512i label = _mm512_loadu_si512(row.ends.is_end + u);
    const __mmask16 is_end = _mm512_test_epi32_mask(label, label);
    if (row.mask != nullptr) {
      const __m512i value =
          _mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row.mask + u)));
      label = _mm512_mask_add_epi32(label, is_end, label, _mm512_min_epi32(value, most));
    }
    _mm512_storeu_si512(row.label + u, label);
    const __m512i x = _mm512_loadu_si512(row.ends.x + u);
    const __m512i y = _mm512_loadu_si512(row.ends.y + u);
    const __m512i z = _mm512_loadu_si512(row.ends.z + u);
    const auto alike = [&](__mmask16 lanes, __m512i l, __m512i x2, __m512i y2, __m512i z2)
                           CANOPEER_TARGET_AVX512 {
                             lanes = _mm512_mask_cmpeq_epi32_mask(lanes, label, l);
                             lanes = _mm512_mask_cmpeq_epi32_mask(lanes, x, x2);
                             lanes = _mm512_mask_cmpeq_epi32_mask(lanes, y, y2);
                             return _mm512_mask_cmpeq_epi32_mask(lanes, z, z2);
                           };
    const __mmask16 as_left = alike(
        is_end, _mm512_alignr_epi32(label, label_before, 15), _mm512_alignr_epi32(x, x_before, 15),
        _mm512_alignr_epi32(y, y_before, 15), _mm512_alignr_epi32(z, z_before, 15));
    const __mmask16 as_above =
        alike(is_end, _mm512_loadu_si512(row.label_above + u), _mm512_loadu_si512(row.above.x + u),
              _mm512_loadu_si512(row.above.y + u), _mm512_loadu_si512(row.above.z + u));
    const unsigned fresh = is_end & ~unsigned{_kor_mask16(as_left, as_above)};
    first[u / 64] |= std::uint64_t{fresh} << u % 64;
    label_before = label;
    x_before = x;
    y_before = y;
    z_before = z;
  }
  first_pixels_from(row, u, first);
}

#endif

}  // namespace

FirstPixelsKernel first_pixels_kernel([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_EACH_LEVEL(level, first_pixels);
}

}  // namespace canopeer
