#include "canopeer/map/free_voxel_parts.h"

#if defined(__x86_64__)

#include <immintrin.h>

#include <algorithm>
#include <bit>

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

// Of a window's pixels, bit u of row v: farther than all of the voxels, at least as far as some.
struct Outline {
  __m512i all[2], any[2];
};

// Sixteen voxels: how deep they lie and the pixels they fall on.
struct Voxels {
  __m512 depth;
  __m512i u, v;
};

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
      if (fits(window)) {
        find_by_outline(apart, window);
      } else {
        rest |= find_one_by_one(apart);
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
      if (fits(window)) {
        find_by_outline(half, window);
      } else {
        rest |= half;
      }
    }
    return rest;
  }

  CANOPEER_INLINE_AVX512 Window window_of(unsigned which) const {
    const PixelRects& rects = halves_.rects;
    const std::size_t lane = 8 * halves_.place;
    int u0 = camera_.width, v0 = camera_.height, u1 = -1, v1 = -1;
    float nearest = camera_.largest, farthest = 0.0F;
    for (; which != 0; which &= which - 1) {
      const auto half = static_cast<unsigned>(std::countr_zero(which));
      u0 = std::min(u0, rects.u0[lane + half]);
      v0 = std::min(v0, rects.v0[lane + half]);
      u1 = std::max(u1, rects.u1[lane + half]);
      v1 = std::max(v1, rects.v1[lane + half]);
      const float* z = first_[half & 3][2] + (half >> 2) * kHalf;
      const float low = std::min(z[0], z[kHalf - 1]), high = std::max(z[0], z[kHalf - 1]);
      nearest = std::min(nearest, low + projection_.z_least);
      farthest = std::max(farthest, high + projection_.z_most);
    }
    return {u0, v0, u1 - u0 + 1, v1 - v0 + 1, nearest, farthest};
  }

  CANOPEER_INLINE_AVX512 __m512i coarse(float depth) const {
    const float level = std::min(depth * camera_.coarse_scale, 65535.0F);
    return _mm512_set1_epi16(static_cast<std::int16_t>(static_cast<std::uint16_t>(level)));
  }

  CANOPEER_INLINE_AVX512 Outline outline_of(const Window& window) const {
    alignas(64) std::uint32_t all[kSide];
    alignas(64) std::uint32_t any[kSide];
    const __m512i nearest = coarse(window.nearest), farthest = coarse(window.farthest);
    const std::uint16_t* row = camera_.coarse_depth + window.v0 * camera_.width + window.u0;
    for (int v = 0; v < window.height; ++v, row += camera_.width) {
      const __m512i depth = _mm512_loadu_si512(row);
      all[v] = _mm512_cmpgt_epu16_mask(depth, farthest);
      any[v] = _mm512_cmpge_epu16_mask(depth, nearest);
    }
    return {{_mm512_load_si512(all), _mm512_load_si512(all + 16)},
            {_mm512_load_si512(any), _mm512_load_si512(any + 16)}};
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

  // Keeps a slice for the end; `pixel` where it is seen.
  CANOPEER_INLINE_AVX512 void keep(unsigned k, const Voxels& of, __mmask16 seen, __m512i pixel) {
    const std::size_t first = count_ * kHalfVoxels + 16 * k;
    _mm512_store_ps(depth_ + first, of.depth);
    _mm512_store_si512(pixel_ + first, _mm512_maskz_mov_epi32(seen, pixel));
  }

  // Each voxel looks up its pixel's bits in registers. Only where some pixel lies between the
  // voxels' depths must depths be compared.
  CANOPEER_INLINE_AVX512 void find_by_outline(unsigned which, const Window& window) {
    const Outline outline = outline_of(window);
    const __m512i u0 = _mm512_set1_epi32(window.u0), v0 = _mm512_set1_epi32(window.v0);
    const __m512i width = _mm512_set1_epi32(window.width);
    const __m512i height = _mm512_set1_epi32(window.height);
    const __m512i stride = _mm512_set1_epi32(camera_.width);
    const __m512i one = _mm512_set1_epi32(1);
    for (; which != 0; which &= which - 1) {
      const auto half = static_cast<unsigned>(std::countr_zero(which));
      std::uint64_t all = 0, any = 0, seen = 0;
      for (unsigned k = 0; k < kHalf; ++k) {
        const Voxels of = voxels(half, k);
        const __m512i u = _mm512_sub_epi32(of.u, u0), v = _mm512_sub_epi32(of.v, v0);
        const __mmask16 inside =
            _mm512_mask_cmplt_epu32_mask(_mm512_cmplt_epu32_mask(u, width), v, height);
        const __m512i bit = _mm512_sllv_epi32(one, u);
        const auto in = [&](const __m512i(&rows)[2]) CANOPEER_TARGET_AVX512 {
          const __m512i row = _mm512_permutex2var_epi32(rows[0], v, rows[1]);
          return std::uint64_t{_mm512_mask_test_epi32_mask(inside, row, bit)} << (16 * k);
        };
        all |= in(outline.all);
        any |= in(outline.any);
        seen |= std::uint64_t{inside} << (16 * k);
        keep(k, of, inside, _mm512_add_epi32(_mm512_mullo_epi32(of.v, stride), of.u));
      }
      free_[half] = all;
      looked_at_[count_] = half;
      seen_[count_] = seen;
      count_ += all != any;
    }
  }

  CANOPEER_INLINE_AVX512 void project(unsigned half) {
    const __m512i width = _mm512_set1_epi32(camera_.width);
    const __m512i height = _mm512_set1_epi32(camera_.height);
    std::uint64_t seen = 0;
    for (unsigned k = 0; k < kHalf; ++k) {
      const Voxels of = voxels(half, k);
      const __mmask16 before = _mm512_cmp_ps_mask(of.depth, _mm512_setzero_ps(), _CMP_GT_OQ);
      const __mmask16 inside = _mm512_mask_cmplt_epu32_mask(
          _mm512_mask_cmplt_epu32_mask(before, of.u, width), of.v, height);
      seen |= std::uint64_t{inside} << (16 * k);
      keep(k, of, inside, _mm512_add_epi32(_mm512_mullo_epi32(of.v, width), of.u));
    }
    looked_at_[count_] = half;
    seen_[count_] = seen;
    count_ += seen != 0;
  }

  CANOPEER_INLINE_AVX512 void compare_depths() {
    look_up_depths(camera_.depth, pixel_, count_ * kHalfVoxels, surface_);
    for (std::size_t i = 0; i < count_; ++i) {
      std::uint64_t nearer = 0;
      for (unsigned k = 0; k < kHalf; ++k) {
        const std::size_t at = i * kHalfVoxels + 16 * k;
        const __mmask16 bits = _mm512_cmp_ps_mask(_mm512_load_ps(depth_ + at),
                                                  _mm512_load_ps(surface_ + at), _CMP_LT_OQ);
        nearer |= std::uint64_t{bits} << (16 * k);
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
  alignas(64) float surface_[kBlockVoxels];
  alignas(64) std::int32_t pixel_[kBlockVoxels + kHalfVoxels];
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
