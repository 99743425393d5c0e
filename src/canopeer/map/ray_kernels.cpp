#include "canopeer/map/ray_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstring>

#include "canopeer/map/kernel_targets.h"

namespace canopeer {
namespace {

constexpr std::size_t kLanes = RayLanes::kCount;
constexpr PackedVoxel kBlockPart = ~packed_voxel::kInBlock;
// Shifts and masks that bring y and z within the block beside x.
constexpr int kShiftY = packed_voxel::kFieldBits - kBlockShift;
constexpr int kShiftZ = 2 * kShiftY;
constexpr PackedVoxel kMaskX = kBlockSide - 1;
constexpr PackedVoxel kMaskY = kMaskX << kBlockShift;
constexpr PackedVoxel kMaskZ = kMaskY << kBlockShift;

// At equal times y goes before x, x before z. Which axis steps next is as good as random, so there
// is no branch on it.
void walk_rays_scalar(const RayLanes& rays, std::size_t voxels, const RaySteps& out) {
  std::fill_n(out.enters, voxels, std::uint8_t{0});
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    PackedVoxel at = rays.at[lane], before = ~at;
    std::int64_t tx = rays.t[0][lane], ty = rays.t[1][lane], tz = rays.t[2][lane];
    for (std::size_t step = 0; step < voxels; ++step) {
      out.at[step * kLanes + lane] = at;
      out.offset[step * kLanes + lane] = static_cast<std::uint16_t>(
          (at & kMaskX) | (at >> kShiftY & kMaskY) | (at >> kShiftZ & kMaskZ));
      const bool enters = ((at ^ before) & kBlockPart) != 0;
      out.enters[step] = static_cast<std::uint8_t>(out.enters[step] | unsigned{enters} << lane);
      before = at;
      const auto x_before_y = -static_cast<std::int64_t>(tx < ty);
      const auto on_z = -static_cast<std::int64_t>(tz < std::min(tx, ty));
      const std::int64_t on_x = x_before_y & ~on_z;
      const std::int64_t on_y = ~x_before_y & ~on_z;
      at += (rays.move[0][lane] & on_x) | (rays.move[1][lane] & on_y) | (rays.move[2][lane] & on_z);
      tx += rays.dt[0][lane] & on_x;
      ty += rays.dt[1][lane] & on_y;
      tz += rays.dt[2][lane] & on_z;
    }
  }
}

#if defined(__x86_64__)

[[gnu::always_inline]] CANOPEER_TARGET_AVX2 inline __m256i four(const std::int64_t* lanes) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(lanes));
}

CANOPEER_TARGET_AVX2 void walk_rays_avx2(const RayLanes& rays, std::size_t voxels,
                                         const RaySteps& out) {
  for (std::size_t first = 0; first < kLanes; first += 4) {
    __m256i at = four(&rays.at[first]), before = _mm256_xor_si256(at, _mm256_set1_epi64x(-1));
    __m256i tx = four(&rays.t[0][first]), ty = four(&rays.t[1][first]),
            tz = four(&rays.t[2][first]);
    const __m256i dx = four(&rays.dt[0][first]), dy = four(&rays.dt[1][first]),
                  dz = four(&rays.dt[2][first]);
    const __m256i mx = four(&rays.move[0][first]), my = four(&rays.move[1][first]),
                  mz = four(&rays.move[2][first]);
    for (std::size_t step = 0; step < voxels; ++step) {
      const std::size_t place = step * kLanes + first;
      _mm256_store_si256(reinterpret_cast<__m256i*>(out.at + place), at);
      const __m256i offset = _mm256_or_si256(
          _mm256_or_si256(
              _mm256_and_si256(at, _mm256_set1_epi64x(kMaskX)),
              _mm256_and_si256(_mm256_srli_epi64(at, kShiftY), _mm256_set1_epi64x(kMaskY))),
          _mm256_and_si256(_mm256_srli_epi64(at, kShiftZ), _mm256_set1_epi64x(kMaskZ)));
      alignas(32) std::int64_t offsets[4];
      _mm256_store_si256(reinterpret_cast<__m256i*>(offsets), offset);
      for (std::size_t i = 0; i < 4; ++i) {
        out.offset[place + i] = static_cast<std::uint16_t>(offsets[i]);
      }
      const __m256i same = _mm256_cmpeq_epi64(
          _mm256_and_si256(_mm256_xor_si256(at, before), _mm256_set1_epi64x(kBlockPart)),
          _mm256_setzero_si256());
      const unsigned enters = ~static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(same)));
      const unsigned others = first == 0 ? 0U : out.enters[step];
      out.enters[step] = static_cast<std::uint8_t>(others | (enters & 0xFU) << first);
      before = at;
      const __m256i x_before_y = _mm256_cmpgt_epi64(ty, tx);
      const __m256i xy = _mm256_blendv_epi8(ty, tx, x_before_y);
      const __m256i on_z = _mm256_cmpgt_epi64(xy, tz);
      const __m256i on_x = _mm256_andnot_si256(on_z, x_before_y);
      const __m256i on_xz = _mm256_or_si256(on_z, x_before_y);
      at = _mm256_add_epi64(at, _mm256_or_si256(_mm256_or_si256(_mm256_and_si256(mx, on_x),
                                                                _mm256_andnot_si256(on_xz, my)),
                                                _mm256_and_si256(mz, on_z)));
      tx = _mm256_add_epi64(tx, _mm256_and_si256(dx, on_x));
      ty = _mm256_add_epi64(ty, _mm256_andnot_si256(on_xz, dy));
      tz = _mm256_add_epi64(tz, _mm256_and_si256(dz, on_z));
    }
  }
}

CANOPEER_TARGET_AVX512 void walk_rays_avx512(const RayLanes& rays, std::size_t voxels,
                                             const RaySteps& out) {
  __m512i at = _mm512_load_si512(rays.at.data()),
          before = _mm512_xor_si512(at, _mm512_set1_epi64(-1));
  __m512i tx = _mm512_load_si512(rays.t[0].data()), ty = _mm512_load_si512(rays.t[1].data()),
          tz = _mm512_load_si512(rays.t[2].data());
  const __m512i dx = _mm512_load_si512(rays.dt[0].data()),
                dy = _mm512_load_si512(rays.dt[1].data()),
                dz = _mm512_load_si512(rays.dt[2].data());
  const __m512i mx = _mm512_load_si512(rays.move[0].data()),
                my = _mm512_load_si512(rays.move[1].data()),
                mz = _mm512_load_si512(rays.move[2].data());
  for (std::size_t step = 0; step < voxels; ++step) {
    const std::size_t place = step * kLanes;
    _mm512_store_si512(out.at + place, at);
    const __m512i offset = _mm512_or_si512(
        _mm512_or_si512(
            _mm512_and_si512(at, _mm512_set1_epi64(kMaskX)),
            _mm512_and_si512(_mm512_srli_epi64(at, kShiftY), _mm512_set1_epi64(kMaskY))),
        _mm512_and_si512(_mm512_srli_epi64(at, kShiftZ), _mm512_set1_epi64(kMaskZ)));
    _mm_store_si128(reinterpret_cast<__m128i*>(out.offset + place), _mm512_cvtepi64_epi16(offset));
    out.enters[step] = static_cast<std::uint8_t>(
        _mm512_test_epi64_mask(_mm512_xor_si512(at, before), _mm512_set1_epi64(kBlockPart)));
    before = at;
    const __mmask8 x_before_y = _mm512_cmplt_epi64_mask(tx, ty);
    const __mmask8 on_z = _mm512_cmplt_epi64_mask(tz, _mm512_min_epi64(tx, ty));
    const auto on_x = static_cast<__mmask8>(x_before_y & ~on_z);
    const auto on_y = static_cast<__mmask8>(~(x_before_y | on_z));
    at = _mm512_mask_add_epi64(at, on_x, at, mx);
    at = _mm512_mask_add_epi64(at, on_y, at, my);
    at = _mm512_mask_add_epi64(at, on_z, at, mz);
    tx = _mm512_mask_add_epi64(tx, on_x, tx, dx);
    ty = _mm512_mask_add_epi64(ty, on_y, ty, dy);
    tz = _mm512_mask_add_epi64(tz, on_z, tz, dz);
  }
}

#endif

// An 8 × 8 matrix of bits, a row a byte: bit j of byte i becomes bit i of byte j (Warren, Hacker's
// Delight, 2nd ed., 7-3).
std::uint64_t transposed(std::uint64_t m) {
  const auto swap = [&m](int distance, std::uint64_t which) {
    const std::uint64_t differ = (m ^ (m >> distance)) & which;
    m ^= differ ^ (differ << distance);
  };
  swap(7, 0x00AA00AA00AA00AA);
  swap(14, 0x0000CCCC0000CCCC);
  swap(28, 0x00000000F0F0F0F0);
  return m;
}

}  // namespace

std::size_t turn_enters(const std::uint8_t* enters, std::size_t steps, std::uint64_t* rows) {
  const std::size_t words = (steps + 63) / 64;
  static_assert(std::endian::native == std::endian::little);
  for (std::size_t eight = 0; 8 * eight < steps; ++eight) {
    std::uint64_t m = 0;
    std::memcpy(&m, enters + 8 * eight, sizeof m);
    m = transposed(m);
    auto* const bytes = reinterpret_cast<std::uint8_t*>(rows) + eight;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      bytes[lane * words * 8] = static_cast<std::uint8_t>(m >> (8 * lane));
    }
  }
  return words;
}

WalkRays walk_rays_kernel([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_LEVEL(level, walk_rays);
}

}  // namespace canopeer
