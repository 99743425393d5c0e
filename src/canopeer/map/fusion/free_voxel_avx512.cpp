#include "canopeer/map/fusion/free_voxel_parts.h"

#if defined(__x86_64__)

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <climits>

#define CANOPEER_INLINE_AVX512 [[gnu::always_inline]] CANOPEER_TARGET_AVX512 inline

namespace canopeer {
namespace {

constexpr int kSide = 32;  // pixels a row and rows of a window: what two registers hold
constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;

// The pixels that the voxels of some half blocks can fall on, and the depths these lie between.
struct Window {
  int u0, v0, width, height;
  float nearest, farthest;
};

// Of a window's pixels, bit u % 32 of row v % 32: farther than the voxels.
struct Outline {
  __m512i rows[2];
  bool clear;  // no pixel lies between the voxels
};

// Sixteen voxels: how deep they lie and the pixels they fall on.
struct Voxels {
  __m512 depth;
  __m512i u, v;
};

// surface[i] = depth[pixel[i]] for `count` pixels, a multiple of 8, one by one.
CANOPEER_ONE_BY_ONE void look_up_coarse(const std::uint16_t* depth, const std::int32_t* pixel,
                                        std::size_t count, std::uint16_t* surface) {
  for (std::size_t i = 0; i < count; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) surface[i + k] = depth[pixel[i + k]];
  }
}

// What one look at a block needs at hand; what remains to be compared depth by depth is kept for
// the end, so that none waits for what the one before stored.
class BlockTest {
 public:
  CANOPEER_INLINE_AVX512 BlockTest(const FlatPyramid& camera, const BlockProjection& projection,
                                   const std::array<int, 3>& corner, const HalfBlocks& halves)
      : camera_(camera), projection_(projection), halves_(halves) {
    find_first_centres(projection, corner, first_);
    const __mmask8 all = static_cast<__mmask8>(halves.all_free());
    _mm512_store_si512(free_, _mm512_maskz_set1_epi64(all, -1));
  }

  CANOPEER_INLINE_AVX512 VoxelMask find() {
    const unsigned apart = halves_.undecided() & halves_.apart();
    unsigned rest = halves_.undecided() & ~apart;
    if (apart != 0) {
      const Window window = window_of(apart);
      if (!fits(window)) {
        rest |= find_one_by_one(apart);
      } else if (!find_by_outline(apart, window)) {
        rest |= apart;
      }
    }
    for (; rest != 0; rest &= rest - 1) project(static_cast<unsigned>(std::countr_zero(rest)));
    compare_depths();
    return join();
  }

 private:
  static bool fits(const Window& window) { return window.width <= kSide && window.height <= kSide; }

  CANOPEER_INLINE_AVX512 unsigned find_one_by_one(unsigned which) {
    unsigned rest = 0;
    for (; which != 0; which &= which - 1) {
      const unsigned half = which & ~(which - 1);
      const Window window = window_of(half);
      if (!fits(window) || !find_by_outline(half, window)) rest |= half;
    }
    return rest;
  }

  CANOPEER_INLINE_AVX512 Window window_of(unsigned which) const {
    const PixelRects& rects = halves_.rects;
    const std::size_t lane = 8 * halves_.place;
    const auto mask = static_cast<__mmask8>(which);
    const auto load = [&](const auto& lanes) CANOPEER_TARGET_AVX512 {
      return _mm256_mask_loadu_epi32(_mm256_set1_epi32(INT_MAX), mask, &lanes[lane]);
    };
    const auto load_inverse = [&](const auto& lanes) CANOPEER_TARGET_AVX512 {
      const __m256i ones = _mm256_set1_epi32(-1);
      return _mm256_mask_xor_epi32(_mm256_set1_epi32(INT_MAX), mask, ones,
                                   _mm256_maskz_loadu_epi32(mask, &lanes[lane]));
    };
    // Six minima side by side. Depths are positive, so they compare as integers do.
    const __m512i first =
        _mm512_inserti64x4(_mm512_castsi256_si512(load(rects.u0)), load(rects.v0), 1);
    const __m512i last = _mm512_inserti64x4(_mm512_castsi256_si512(load_inverse(rects.u1)),
                                            load_inverse(rects.v1), 1);
    const __m512i depth =
        _mm512_inserti64x4(_mm512_castsi256_si512(load(rects.near)), load_inverse(rects.far), 1);
    const __m512i pairs =
        _mm512_min_epi32(_mm512_unpacklo_epi32(first, last), _mm512_unpackhi_epi32(first, last));
    const __m512i twice =
        _mm512_min_epi32(_mm512_unpacklo_epi32(depth, depth), _mm512_unpackhi_epi32(depth, depth));
    // Of each 128 bits: first, last, depth, depth.
    const __m512i all =
        _mm512_min_epi32(_mm512_unpacklo_epi64(pairs, twice), _mm512_unpackhi_epi64(pairs, twice));
    const __m512i least = _mm512_min_epi32(all, _mm512_shuffle_i64x2(all, all, 0b10110001));
    const __m128i u = _mm512_castsi512_si128(least), v = _mm512_extracti32x4_epi32(least, 2);
    const int u0 = _mm_cvtsi128_si32(u), u1 = ~_mm_extract_epi32(u, 1);
    const int v0 = _mm_cvtsi128_si32(v), v1 = ~_mm_extract_epi32(v, 1);
    return {u0,
            v0,
            u1 - u0 + 1,
            v1 - v0 + 1,
            std::bit_cast<float>(_mm_extract_epi32(u, 2)),
            std::bit_cast<float>(~_mm_extract_epi32(v, 2))};
  }

  CANOPEER_INLINE_AVX512 __m512i coarse(float depth) const {
    const float level = std::min(depth * camera_.coarse_scale, 65535.0F);
    return _mm512_set1_epi16(static_cast<std::int16_t>(static_cast<std::uint16_t>(level)));
  }

  // Rows are kept where their pixels' numbers say, modulo 32, and turned likewise: so voxels look
  // their pixels up without a look at where the window begins.
  CANOPEER_INLINE_AVX512 Outline outline_of(const Window& window) const {
    alignas(64) std::uint32_t rows[kSide];
    const __m512i nearest = coarse(window.nearest), farthest = coarse(window.farthest);
    const std::uint16_t* row = camera_.coarse_depth + window.v0 * camera_.width + window.u0;
    __m512i beyond_nearest = _mm512_set1_epi16(-1);  // least of all rows, those nearer not counted
    for (int v = window.v0; v < window.v0 + window.height; ++v, row += camera_.width) {
      const __m512i depth = _mm512_loadu_si512(row);
      rows[v % kSide] = _mm512_cmpgt_epu16_mask(depth, farthest);
      beyond_nearest = _mm512_min_epu16(beyond_nearest, _mm512_sub_epi16(depth, nearest));
    }
    const std::uint32_t between =
        _mm512_cmple_epu16_mask(beyond_nearest, _mm512_sub_epi16(farthest, nearest));
    const __m512i turn = _mm512_set1_epi32(window.u0);
    return {{_mm512_rolv_epi32(_mm512_load_si512(rows), turn),
             _mm512_rolv_epi32(_mm512_load_si512(rows + 16), turn)},
            between << (kSide - window.width) == 0};
  }

  // Whether voxels of these half blocks can lie beside the image.
  CANOPEER_INLINE_AVX512 bool reaches_border(const Window& window) const {
    return window.u0 == 0 || window.v0 == 0 || window.u0 + window.width == camera_.width ||
           window.v0 + window.height == camera_.height;
  }

  // The voxels of a slice of a half block; where they are not before the camera, anything.
  CANOPEER_INLINE_AVX512 Voxels voxels(unsigned half, unsigned k) const {
    const auto& at = first_[half & 3];
    const unsigned slice = (half >> 2) * kHalf + k;
    const auto along = [&](std::size_t axis,
                           const std::array<float, 16>& offsets) CANOPEER_TARGET_AVX512 {
      return _mm512_add_ps(_mm512_set1_ps(at[axis][slice]), _mm512_load_ps(offsets.data()));
    };
    const __m512 depth = along(2, projection_.z);
    const __m512 inverse = _mm512_div_ps(_mm512_set1_ps(1.0F), depth);
    const __m512 x = along(0, projection_.x), y = along(1, projection_.y);
    const __m512 u =
        _mm512_add_ps(_mm512_mul_ps(_mm512_mul_ps(_mm512_set1_ps(camera_.fx), x), inverse),
                      _mm512_set1_ps(camera_.cx));
    const __m512 v =
        _mm512_add_ps(_mm512_mul_ps(_mm512_mul_ps(_mm512_set1_ps(camera_.fy), y), inverse),
                      _mm512_set1_ps(camera_.cy));
    return {depth, _mm512_cvt_roundps_epi32(u, kDown), _mm512_cvt_roundps_epi32(v, kDown)};
  }

  // Each voxel looks up its pixel's bit in registers; false: some pixel lies between the voxels.
  CANOPEER_INLINE_AVX512 bool find_by_outline(unsigned which, const Window& window) {
    const Outline outline = outline_of(window);
    if (!outline.clear) return false;
    const __m512i one = _mm512_set1_epi32(1);
    const bool all_inside = !reaches_border(window);
    const __m512i width = _mm512_set1_epi32(all_inside ? -1 : camera_.width);
    const __m512i height = _mm512_set1_epi32(all_inside ? -1 : camera_.height);
    for (; which != 0; which &= which - 1) {
      const auto half = static_cast<unsigned>(std::countr_zero(which));
      std::uint64_t farther = 0;
      for (unsigned k = 0; k < kHalf; ++k) {
        const Voxels of = voxels(half, k);
        const __mmask16 inside =
            _mm512_mask_cmplt_epu32_mask(_mm512_cmplt_epu32_mask(of.u, width), of.v, height);
        const __m512i row = _mm512_permutex2var_epi32(outline.rows[0], of.v, outline.rows[1]);
        const __m512i bit = _mm512_rolv_epi32(one, of.u);
        farther |= std::uint64_t{_mm512_mask_test_epi32_mask(inside, row, bit)} << (16 * k);
      }
      free_[half] = farther;
    }
    return true;
  }

  // Keeps a half block's voxels for the end.
  CANOPEER_INLINE_AVX512 void project(unsigned half) {
    const __m512i width = _mm512_set1_epi32(camera_.width);
    const __m512i height = _mm512_set1_epi32(camera_.height);
    const __m512 scale = _mm512_set1_ps(camera_.coarse_scale);
    const __m512 most = _mm512_set1_ps(65535.0F);
    std::uint64_t seen = 0;
    for (unsigned k = 0; k < kHalf; ++k) {
      const Voxels of = voxels(half, k);
      const __mmask16 before = _mm512_cmp_ps_mask(of.depth, _mm512_setzero_ps(), _CMP_GT_OQ);
      const __mmask16 inside = _mm512_mask_cmplt_epu32_mask(
          _mm512_mask_cmplt_epu32_mask(before, of.u, width), of.v, height);
      seen |= std::uint64_t{inside} << (16 * k);
      const __m512i pixel = _mm512_add_epi32(_mm512_mullo_epi32(of.v, width), of.u);
      const __m512i coarse =
          _mm512_cvttps_epi32(_mm512_min_ps(_mm512_mul_ps(of.depth, scale), most));
      const std::size_t first = count_ * kHalfVoxels + 16 * k;
      _mm512_store_ps(depth_ + first, of.depth);
      _mm512_store_si512(pixel_ + first, _mm512_maskz_mov_epi32(inside, pixel));
      _mm256_store_si256(reinterpret_cast<__m256i*>(coarse_ + first),
                         _mm512_cvtepi32_epi16(coarse));
    }
    looked_at_[count_] = half;
    seen_[count_] = seen;
    count_ += seen != 0;
  }

  // Coarse depths first, which are at hand; those themselves where they are alike.
  CANOPEER_INLINE_AVX512 void compare_depths() {
    look_up_coarse(camera_.coarse_depth, pixel_, count_ * kHalfVoxels, surface_);
    for (std::size_t i = 0; i < count_; ++i) {
      std::uint64_t nearer = 0, alike = 0;
      for (unsigned part = 0; part < 2; ++part) {
        const std::size_t at = i * kHalfVoxels + 32 * part;
        const __m512i voxel = _mm512_load_si512(coarse_ + at);
        const __m512i surface = _mm512_load_si512(surface_ + at);
        nearer |= std::uint64_t{_mm512_cmplt_epu16_mask(voxel, surface)} << (32 * part);
        alike |= std::uint64_t{_mm512_cmpeq_epu16_mask(voxel, surface)} << (32 * part);
      }
      for (std::uint64_t bits = alike & seen_[i]; bits != 0; bits &= bits - 1) {
        const std::size_t at = i * kHalfVoxels + static_cast<std::size_t>(std::countr_zero(bits));
        if (depth_[at] < camera_.depth[pixel_[at]]) nearer |= bits & (~bits + 1);
      }
      free_[looked_at_[i]] = nearer & seen_[i];
    }
  }

  // The bits of the half blocks, 4 · 4 a slice, to where a block's mask has them.
  CANOPEER_INLINE_AVX512 VoxelMask join() const {
    // Slice k: the words k of halves 0 and 2 (x below) and of 1 and 3; of 4 … 7 from slice 4 on.
    const __m512i words =
        _mm512_set_epi16(31, 23, 27, 19, 30, 22, 26, 18, 29, 21, 25, 17, 28, 20, 24, 16, 15, 7, 11,
                         3, 14, 6, 10, 2, 13, 5, 9, 1, 12, 4, 8, 0);
    const __m512i halves = _mm512_permutexvar_epi16(words, _mm512_load_si512(free_));
    // Each byte, two rows of four, twice in 16 bits; the rows then to bytes of their own.
    const auto rows_of = [&](int first) CANOPEER_TARGET_AVX512 {
      const __m512i twice = _mm512_broadcast_i32x4(
          _mm_add_epi8(_mm_setr_epi8(0, 0, 1, 1, 2, 2, 3, 3, 8, 8, 9, 9, 10, 10, 11, 11),
                       _mm_set1_epi8(static_cast<char>(first))));
      const __m512i bytes = _mm512_shuffle_epi8(halves, twice);
      return _mm512_or_si512(
          _mm512_and_si512(bytes, _mm512_set1_epi16(0x000F)),
          _mm512_and_si512(_mm512_srli_epi16(bytes, 4), _mm512_set1_epi16(0x0F00)));
    };
    VoxelMask mask;
    _mm512_storeu_si512(mask.slices.data(),
                        _mm512_or_si512(rows_of(0), _mm512_slli_epi16(rows_of(4), 4)));
    return mask;
  }

  const FlatPyramid& camera_;
  const BlockProjection& projection_;
  const HalfBlocks& halves_;
  alignas(64) FirstCentres first_;
  alignas(64) std::uint64_t free_[8];
  alignas(64) float depth_[kBlockVoxels + kHalfVoxels];
  alignas(64) std::int32_t pixel_[kBlockVoxels + kHalfVoxels];
  alignas(64) std::uint16_t coarse_[kBlockVoxels + kHalfVoxels];
  alignas(64) std::uint16_t surface_[kBlockVoxels];
  std::uint64_t seen_[9];
  unsigned looked_at_[9];
  std::size_t count_ = 0;
};

}  // namespace

CANOPEER_TARGET_AVX512 VoxelMask free_in_block_avx512(const FlatPyramid& camera,
                                                      const BlockProjection& projection,
                                                      const std::array<int, 3>& corner,
                                                      const HalfBlocks& halves) {
  return BlockTest(camera, projection, corner, halves).find();
}

}  // namespace canopeer

#endif
