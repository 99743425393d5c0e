#include "canopeer/map/storage/log_odds_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <limits>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

constexpr std::size_t kSliceVoxels = kBlockSide * kBlockSide;

void step_scalar(std::int16_t* cells, const VoxelMask& hit, const VoxelMask& miss,
                 const LogOddsSteps& steps, VoxelMask& above) {
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t stepped = hit.slices[z] | miss.slices[z];
    for (std::uint64_t bits = stepped; bits != 0; bits &= bits - 1) {
      const std::uint64_t bit = bits & (~bits + 1);
      std::int16_t& cell =
          cells[z * kSliceVoxels + static_cast<std::size_t>(std::countr_zero(bits))];
      const int sum = cell + ((hit.slices[z] & bit) != 0 ? steps.hit : steps.miss);
      cell = static_cast<std::int16_t>(std::clamp<int>(sum, steps.min, steps.max));
      above.slices[z] = (above.slices[z] & ~bit) | (cell >= steps.threshold ? bit : 0);
    }
  }
}

void fill_scalar(std::int16_t* cells, const VoxelMask& mask, std::int16_t value) {
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    for (std::size_t i = 0; i < kSliceVoxels; ++i) {
      cells[z * kSliceVoxels + i] = (mask.slices[z] >> i & 1) != 0 ? value : std::int16_t{0};
    }
  }
}

CANOPEER_KERNEL_BODY LogOddsRange miss_all_body(std::int16_t* cells, const LogOddsSteps& steps) {
  const std::int16_t miss = steps.miss;
  const std::int16_t low = steps.min;
  std::int16_t least = std::numeric_limits<std::int16_t>::max();
  std::int16_t most = low;
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    const auto sum = static_cast<std::int16_t>(cells[i] + miss);
    const std::int16_t now = sum < low ? low : sum;
    cells[i] = now;
    least = now < least ? now : least;
    most = now > most ? now : most;
  }
  return {least, most};
}

LogOddsRange miss_all_scalar(std::int16_t* cells, const LogOddsSteps& steps) {
  return miss_all_body(cells, steps);
}

// 8 voxels at a time; a mask's bits are spread over the lanes they stand for.
using EightShorts = std::int16_t __attribute__((vector_size(16)));
constexpr EightShorts kLaneBit = {1, 2, 4, 8, 16, 32, 64, 128};

CANOPEER_KERNEL_BODY EightShorts lanes_of(std::uint64_t bits) {
  return (static_cast<std::int16_t>(bits & 0xFF) & kLaneBit) == kLaneBit;
}

// Bit i: lane i is set.
CANOPEER_KERNEL_BODY std::uint64_t bits_of(const EightShorts& lanes) {
#if defined(__ARM_NEON)
  return static_cast<std::uint64_t>(vaddvq_s16(lanes & kLaneBit));
#elif defined(__x86_64__)
  return static_cast<std::uint64_t>(
      _mm_movemask_epi8(_mm_packs_epi16(reinterpret_cast<__m128i>(lanes), _mm_setzero_si128())));
#else
  std::uint64_t bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(lanes[i] & 1) << i;
  return bits;
#endif
}

void step_narrow(std::int16_t* cells, const VoxelMask& hit, const VoxelMask& miss,
                 const LogOddsSteps& steps, VoxelMask& above) {
  const auto low = all_lanes<EightShorts>(steps.min), high = all_lanes<EightShorts>(steps.max);
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t stepped = hit.slices[z] | miss.slices[z];
    if (stepped == 0) continue;
    std::uint64_t now_above = 0;
    for (unsigned shift = 0; shift < kSliceVoxels; shift += 8) {
      if ((stepped >> shift & 0xFF) == 0) continue;
      std::int16_t* place = cells + z * kSliceVoxels + shift;
      const auto row = load_lanes<EightShorts>(place);
      const EightShorts hits = lanes_of(hit.slices[z] >> shift);
      const EightShorts misses = lanes_of(miss.slices[z] >> shift);
      EightShorts next = row + ((hits & steps.hit) | (misses & steps.miss));
      next = next < low ? low : next;
      next = next > high ? high : next;
      const EightShorts now = (hits | misses) ? next : row;
      store_lanes(now, place);
      now_above |= bits_of(now >= steps.threshold) << shift;
    }
    above.slices[z] = (above.slices[z] & ~stepped) | (now_above & stepped);
  }
}

void fill_narrow(std::int16_t* cells, const VoxelMask& mask, std::int16_t value) {
  for (std::size_t i = 0; i < kBlockVoxels; i += 8) {
    store_lanes(lanes_of(mask.slices[i / 64] >> i % 64) & value, cells + i);
  }
}

#if defined(__x86_64__)

// 16 voxels at a time; a mask's bits are spread over the lanes they stand for.
CANOPEER_TARGET_AVX2 void step_avx2(std::int16_t* cells, const VoxelMask& hit,
                                    const VoxelMask& miss, const LogOddsSteps& steps,
                                    VoxelMask& above) {
  const __m256i lane_bit = _mm256_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048,
                                             4096, 8192, 16384, -32768);
  const __m256i hit_step = _mm256_set1_epi16(steps.hit);
  const __m256i miss_step = _mm256_set1_epi16(steps.miss);
  const __m256i low = _mm256_set1_epi16(steps.min);
  const __m256i high = _mm256_set1_epi16(steps.max);
  const __m256i below_threshold = _mm256_set1_epi16(static_cast<std::int16_t>(steps.threshold - 1));
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t stepped = hit.slices[z] | miss.slices[z];
    if (stepped == 0) continue;
    std::uint64_t now_above = 0;
    for (unsigned part = 0; part < 4; ++part) {
      const unsigned shift = 16 * part;
      const auto hits = static_cast<std::int16_t>(hit.slices[z] >> shift);
      const auto misses = static_cast<std::int16_t>(miss.slices[z] >> shift);
      if (hits == 0 && misses == 0) continue;
      auto* place = reinterpret_cast<__m256i*>(cells + z * kSliceVoxels + shift);
      const __m256i row = _mm256_loadu_si256(place);
      const __m256i hit_lanes =
          _mm256_cmpeq_epi16(_mm256_and_si256(_mm256_set1_epi16(hits), lane_bit), lane_bit);
      const __m256i miss_lanes =
          _mm256_cmpeq_epi16(_mm256_and_si256(_mm256_set1_epi16(misses), lane_bit), lane_bit);
      const __m256i step = _mm256_or_si256(_mm256_and_si256(hit_lanes, hit_step),
                                           _mm256_and_si256(miss_lanes, miss_step));
      const __m256i next =
          _mm256_min_epi16(_mm256_max_epi16(_mm256_add_epi16(row, step), low), high);
      const __m256i now = _mm256_blendv_epi8(row, next, _mm256_or_si256(hit_lanes, miss_lanes));
      _mm256_storeu_si256(place, now);
      const __m256i lanes_above = _mm256_cmpgt_epi16(now, below_threshold);
      const __m256i bytes = _mm256_permute4x64_epi64(
          _mm256_packs_epi16(lanes_above, _mm256_setzero_si256()), 0b11011000);
      const auto bits = static_cast<unsigned>(_mm256_movemask_epi8(bytes)) & 0xFFFFU;
      now_above |= std::uint64_t{bits} << shift;
    }
    above.slices[z] = (above.slices[z] & ~stepped) | (now_above & stepped);
  }
}

// 32 voxels at a time; the masks are the machine's.
CANOPEER_TARGET_AVX512 void step_avx512(std::int16_t* cells, const VoxelMask& hit,
                                        const VoxelMask& miss, const LogOddsSteps& steps,
                                        VoxelMask& above) {
  const __m512i hit_step = _mm512_set1_epi16(steps.hit);
  const __m512i miss_step = _mm512_set1_epi16(steps.miss);
  const __m512i low = _mm512_set1_epi16(steps.min);
  const __m512i high = _mm512_set1_epi16(steps.max);
  const __m512i threshold = _mm512_set1_epi16(steps.threshold);
  for (std::size_t z = 0; z < kBlockSide; ++z) {
    const std::uint64_t stepped = hit.slices[z] | miss.slices[z];
    if (stepped == 0) continue;
    std::uint64_t now_above = 0;
    for (unsigned shift = 0; shift < 64; shift += 32) {
      const auto hits = static_cast<__mmask32>(hit.slices[z] >> shift);
      const auto misses = static_cast<__mmask32>(miss.slices[z] >> shift);
      if ((hits | misses) == 0) continue;
      std::int16_t* place = cells + z * kSliceVoxels + shift;
      const __m512i row = _mm512_loadu_si512(place);
      __m512i next = _mm512_mask_add_epi16(row, hits, row, hit_step);
      next = _mm512_mask_add_epi16(next, misses, row, miss_step);
      next = _mm512_min_epi16(_mm512_max_epi16(next, low), high);
      const __m512i now = _mm512_mask_mov_epi16(row, hits | misses, next);
      _mm512_storeu_si512(place, now);
      now_above |= std::uint64_t{_mm512_cmpge_epi16_mask(now, threshold)} << shift;
    }
    above.slices[z] = (above.slices[z] & ~stepped) | (now_above & stepped);
  }
}

CANOPEER_TARGET_AVX2 void fill_avx2(std::int16_t* cells, const VoxelMask& mask,
                                    std::int16_t value) {
  const __m256i lane_bit = _mm256_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048,
                                             4096, 8192, 16384, -32768);
  const __m256i values = _mm256_set1_epi16(value);
  for (std::size_t i = 0; i < kBlockVoxels; i += 16) {
    const auto bits = static_cast<std::int16_t>(mask.slices[i / 64] >> i % 64);
    const __m256i lanes =
        _mm256_cmpeq_epi16(_mm256_and_si256(_mm256_set1_epi16(bits), lane_bit), lane_bit);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(cells + i), _mm256_and_si256(lanes, values));
  }
}

CANOPEER_TARGET_AVX512 void fill_avx512(std::int16_t* cells, const VoxelMask& mask,
                                        std::int16_t value) {
  for (std::size_t i = 0; i < kBlockVoxels; i += 32) {
    const auto lanes = static_cast<__mmask32>(mask.slices[i / 64] >> i % 64);
    _mm512_storeu_si512(cells + i, _mm512_maskz_set1_epi16(lanes, value));
  }
}

CANOPEER_TARGET_AVX2 LogOddsRange miss_all_avx2(std::int16_t* cells, const LogOddsSteps& steps) {
  return miss_all_body(cells, steps);
}

CANOPEER_TARGET_AVX512 LogOddsRange miss_all_avx512(std::int16_t* cells,
                                                    const LogOddsSteps& steps) {
  return miss_all_body(cells, steps);
}

constexpr LogOddsKernels kLogOdds_avx2 = {step_avx2, fill_avx2, miss_all_avx2};
constexpr LogOddsKernels kLogOdds_avx512 = {step_avx512, fill_avx512, miss_all_avx512};
#endif

constexpr LogOddsKernels kLogOdds_scalar = {step_scalar, fill_scalar, miss_all_scalar};
constexpr LogOddsKernels kLogOdds_narrow = {step_narrow, fill_narrow, miss_all_scalar};

}  // namespace

const LogOddsKernels& log_odds_kernels([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_EACH_LEVEL(level, kLogOdds);
}

}  // namespace canopeer
