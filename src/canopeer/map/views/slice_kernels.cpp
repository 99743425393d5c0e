#include "canopeer/map/views/slice_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>

#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

// No branch on what is there: it would be mispredicted.
SliceCount collect_unknown_scalar(std::span<const std::uint32_t> numbers, const MetBlock* blocks,
                                  BlockKey first, const SliceRoom& out) {
  SliceCount count;
  for (const std::uint32_t number : numbers) {
    const MetBlock& block = blocks[number];
    const std::size_t before = count.words;
    out.keys[count.blocks] = first + block.place;
    for (std::size_t z = 0; z < kBlockSide; ++z) {
      out.words[count.words] = block.crossed.slices[z] & ~block.observed->slices[z];
      out.places[count.words] = static_cast<std::uint32_t>(count.blocks * kBlockSide + z);
      count.words += out.words[count.words] != 0 ? 1 : 0;
    }
    count.blocks += count.words != before ? 1 : 0;
  }
  return count;
}

#if defined(__x86_64__)

CANOPEER_TARGET_AVX512 SliceCount collect_unknown_avx512(std::span<const std::uint32_t> numbers,
                                                         const MetBlock* blocks, BlockKey first,
                                                         const SliceRoom& out) {
  const __m256i slices = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  SliceCount count;
  for (const std::uint32_t number : numbers) {
    const MetBlock& block = blocks[number];
    const __m512i unknown = _mm512_andnot_si512(_mm512_loadu_si512(block.observed->slices.data()),
                                                _mm512_load_si512(block.crossed.slices.data()));
    const __mmask8 some = _mm512_test_epi64_mask(unknown, unknown);
    const __m256i places =
        _mm256_add_epi32(slices, _mm256_set1_epi32(static_cast<int>(count.blocks * kBlockSide)));
    out.keys[count.blocks] = first + block.place;
    _mm512_storeu_si512(out.words + count.words, _mm512_maskz_compress_epi64(some, unknown));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out.places + count.words),
                        _mm256_maskz_compress_epi32(some, places));
    count.words += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(some)));
    count.blocks += some != 0 ? 1 : 0;
  }
  return count;
}

#endif

}  // namespace

CollectUnknown collect_unknown_kernel([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return collect_unknown_avx512;
#endif
  return collect_unknown_scalar;
}

}  // namespace canopeer
