#include "canopeer/map/views/ray_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "canopeer/base/simd_vectors.h"
#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

constexpr std::size_t kLanes = RayLanes::kCount;
constexpr PackedVoxel kBlockPart = ~packed_voxel::kInBlock;
constexpr PackedVoxel kSlicePart = kBlockPart | (kBlockSide - 1) * packed_voxel::kOneOf[2];
// The bit of a voxel in its slice: x as it is, y brought beside it.
constexpr int kShiftY = packed_voxel::kFieldBits - kBlockShift;
constexpr int kShiftZ = 2 * packed_voxel::kFieldBits;
constexpr PackedVoxel kMaskX = kBlockSide - 1;
constexpr PackedVoxel kMaskY = kMaskX << kBlockShift;

void start_rays_scalar(const Vec3& from, std::span<const Vec3> ends, double resolution_m,
                       const VoxelIndex& corner, RayLanes& rays) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Vec3& end = ends[std::min(lane, ends.size() - 1)];
    rays.set(lane, VoxelWalk(from, end, resolution_m), corner);
  }
}

// At equal times y goes before x, x before z. Which axis steps next is as good as random, so there
// is no branch on it.
void walk_rays_scalar(const RayLanes& rays, std::size_t voxels, const RaySteps& out) {
  std::fill_n(out.leaves_slice, voxels, std::uint8_t{0});
  std::fill_n(out.leaves_block, voxels, std::uint8_t{0});
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    PackedVoxel at = rays.at[lane];
    std::int64_t tx = rays.t[0][lane], ty = rays.t[1][lane], tz = rays.t[2][lane];
    std::uint64_t run = 0;
    for (std::size_t step = 0; step < voxels; ++step) {
      run |= std::uint64_t{1} << ((at & kMaskX) | (at >> kShiftY & kMaskY));
      out.at[step * kLanes + lane] = at;
      out.slice[step * kLanes + lane] = static_cast<std::uint8_t>(at >> kShiftZ & (kBlockSide - 1));
      out.run[step * kLanes + lane] = run;
      const auto x_before_y = -static_cast<std::int64_t>(tx < ty);
      const auto on_z = -static_cast<std::int64_t>(tz < std::min(tx, ty));
      const std::int64_t on_x = x_before_y & ~on_z;
      const std::int64_t on_y = ~x_before_y & ~on_z;
      const PackedVoxel before = at;
      at += (rays.move[0][lane] & on_x) | (rays.move[1][lane] & on_y) | (rays.move[2][lane] & on_z);
      tx += rays.dt[0][lane] & on_x;
      ty += rays.dt[1][lane] & on_y;
      tz += rays.dt[2][lane] & on_z;
      const bool leaves_slice = ((at ^ before) & kSlicePart) != 0;
      const bool leaves_block = ((at ^ before) & kBlockPart) != 0;
      const auto mark = [&](std::uint8_t& lanes, bool leaves) {
        lanes = static_cast<std::uint8_t>(lanes | unsigned{leaves} << lane);
      };
      mark(out.leaves_slice[step], leaves_slice);
      mark(out.leaves_block[step], leaves_block);
      if (leaves_slice) run = 0;
    }
  }
}

void walk_rays_narrow(const RayLanes& rays, std::size_t voxels, const RaySteps& out) {
  using Two = std::int64_t __attribute__((vector_size(16)));
  const Two one = {1, 1}, none{};
  std::fill_n(out.leaves_slice, voxels, std::uint8_t{0});
  std::fill_n(out.leaves_block, voxels, std::uint8_t{0});
  for (std::size_t lane = 0; lane < kLanes; lane += 2) {
    const auto two = [lane](const RayLanes::Lanes& from) { return load_lanes<Two>(&from[lane]); };
    Two at = two(rays.at), run{};
    Two tx = two(rays.t[0]), ty = two(rays.t[1]), tz = two(rays.t[2]);
    const Two dx = two(rays.dt[0]), dy = two(rays.dt[1]), dz = two(rays.dt[2]);
    const Two mx = two(rays.move[0]), my = two(rays.move[1]), mz = two(rays.move[2]);
    for (std::size_t step = 0; step < voxels; ++step) {
      const std::size_t place = step * kLanes + lane;
      run |= one << ((at & kMaskX) | (at >> kShiftY & kMaskY));
      store_lanes(at, out.at + place);
      const Two slice = at >> kShiftZ & PackedVoxel{kBlockSide - 1};
      out.slice[place] = static_cast<std::uint8_t>(slice[0]);
      out.slice[place + 1] = static_cast<std::uint8_t>(slice[1]);
      store_lanes(run, out.run + place);
      const Two x_before_y = tx < ty;
      const Two on_z = tz < (x_before_y ? tx : ty);
      const Two on_x = x_before_y & ~on_z;
      const Two on_y = ~(x_before_y | on_z);
      const Two before = at;
      at += (mx & on_x) | (my & on_y) | (mz & on_z);
      tx += dx & on_x;
      ty += dy & on_y;
      tz += dz & on_z;
      const Two change = at ^ before;
      const Two leaves_slice = (change & kSlicePart) != none;
      const Two leaves_block = (change & kBlockPart) != none;
      run &= ~leaves_slice;
      const auto mark = [lane](std::uint8_t& lanes, const Two& leaves) {
        lanes = static_cast<std::uint8_t>(lanes | ((leaves[0] & 1) | (leaves[1] & 2)) << lane);
      };
      mark(out.leaves_slice[step], leaves_slice);
      mark(out.leaves_block[step], leaves_block);
    }
  }
}

#if defined(__x86_64__)

[[gnu::always_inline]] CANOPEER_TARGET_AVX2 inline __m256i four(const std::int64_t* lanes) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(lanes));
}

[[gnu::always_inline]] CANOPEER_TARGET_AVX2 inline __m256i none_of(__m256i a, PackedVoxel part) {
  return _mm256_cmpeq_epi64(_mm256_and_si256(a, _mm256_set1_epi64x(part)), _mm256_setzero_si256());
}

[[gnu::always_inline]] CANOPEER_TARGET_AVX2 inline void mark_others(std::uint8_t& lanes,
                                                                    std::size_t first,
                                                                    __m256i stays) {
  const unsigned leaves = ~static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(stays)));
  lanes = static_cast<std::uint8_t>((first == 0 ? 0U : lanes) | (leaves & 0xFU) << first);
}

CANOPEER_TARGET_AVX2 void walk_rays_avx2(const RayLanes& rays, std::size_t voxels,
                                         const RaySteps& out) {
  for (std::size_t first = 0; first < kLanes; first += 4) {
    __m256i at = four(&rays.at[first]), run = _mm256_setzero_si256();
    __m256i tx = four(&rays.t[0][first]), ty = four(&rays.t[1][first]),
            tz = four(&rays.t[2][first]);
    const __m256i dx = four(&rays.dt[0][first]), dy = four(&rays.dt[1][first]),
                  dz = four(&rays.dt[2][first]);
    const __m256i mx = four(&rays.move[0][first]), my = four(&rays.move[1][first]),
                  mz = four(&rays.move[2][first]);
    for (std::size_t step = 0; step < voxels; ++step) {
      const std::size_t place = step * kLanes + first;
      const __m256i bit = _mm256_or_si256(
          _mm256_and_si256(at, _mm256_set1_epi64x(kMaskX)),
          _mm256_and_si256(_mm256_srli_epi64(at, kShiftY), _mm256_set1_epi64x(kMaskY)));
      run = _mm256_or_si256(run, _mm256_sllv_epi64(_mm256_set1_epi64x(1), bit));
      _mm256_store_si256(reinterpret_cast<__m256i*>(out.at + place), at);
      const __m256i slice =
          _mm256_and_si256(_mm256_srli_epi64(at, kShiftZ), _mm256_set1_epi64x(kBlockSide - 1));
      alignas(32) std::int64_t slices[4];
      _mm256_store_si256(reinterpret_cast<__m256i*>(slices), slice);
      for (std::size_t i = 0; i < 4; ++i) {
        out.slice[place + i] = static_cast<std::uint8_t>(slices[i]);
      }
      _mm256_store_si256(reinterpret_cast<__m256i*>(out.run + place), run);
      const __m256i x_before_y = _mm256_cmpgt_epi64(ty, tx);
      const __m256i xy = _mm256_blendv_epi8(ty, tx, x_before_y);
      const __m256i on_z = _mm256_cmpgt_epi64(xy, tz);
      const __m256i on_x = _mm256_andnot_si256(on_z, x_before_y);
      const __m256i on_xz = _mm256_or_si256(on_z, x_before_y);
      const __m256i before = at;
      at = _mm256_add_epi64(at, _mm256_or_si256(_mm256_or_si256(_mm256_and_si256(mx, on_x),
                                                                _mm256_andnot_si256(on_xz, my)),
                                                _mm256_and_si256(mz, on_z)));
      tx = _mm256_add_epi64(tx, _mm256_and_si256(dx, on_x));
      ty = _mm256_add_epi64(ty, _mm256_andnot_si256(on_xz, dy));
      tz = _mm256_add_epi64(tz, _mm256_and_si256(dz, on_z));
      const __m256i change = _mm256_xor_si256(at, before);
      const __m256i stays_slice = none_of(change, kSlicePart);
      run = _mm256_and_si256(run, stays_slice);
      mark_others(out.leaves_slice[step], first, stays_slice);
      mark_others(out.leaves_block[step], first, none_of(change, kBlockPart));
    }
  }
}

// As VoxelWalk sets up one; what it corrects for rounding at a ray's end is left to it.
CANOPEER_TARGET_AVX512 void start_rays_avx512(const Vec3& from, std::span<const Vec3> ends,
                                              double resolution_m, const VoxelIndex& corner,
                                              RayLanes& rays) {
  alignas(64) double to[3][kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Vec3& end = ends[std::min(lane, ends.size() - 1)];
    for (int axis = 0; axis < 3; ++axis) to[axis][lane] = end[axis];
  }
  const VoxelIndex first = voxel_at(from, resolution_m);
  const __m512d resolution = _mm512_set1_pd(resolution_m), zero = _mm512_setzero_pd();
  const __m512d end_time = _mm512_set1_pd(static_cast<double>(VoxelWalk::kEnd));
  const __m512i end = _mm512_set1_epi64(VoxelWalk::kEnd), one = _mm512_set1_epi64(1);
  __m512i steps = _mm512_setzero_si512();
  unsigned rounded = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const __m512d start = _mm512_set1_pd(from[axis]);
    const __m512d d = _mm512_sub_pd(_mm512_load_pd(to[axis]), start);
    const __mmask8 up = _mm512_cmp_pd_mask(d, zero, _CMP_GT_OQ);
    const __m512d voxels = _mm512_roundscale_pd(_mm512_div_pd(_mm512_load_pd(to[axis]), resolution),
                                                _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    const __m512i apart = _mm512_abs_epi64(
        _mm512_sub_epi64(_mm512_cvttpd_epi64(voxels), _mm512_set1_epi64(first[axis])));
    const __m512i crossings =
        _mm512_maskz_mov_epi64(_mm512_cmp_pd_mask(d, zero, _CMP_NEQ_OQ), apart);
    const __m512d face =
        _mm512_mul_pd(_mm512_mask_add_pd(_mm512_set1_pd(first[axis]), up,
                                         _mm512_set1_pd(first[axis]), _mm512_set1_pd(1.0)),
                      resolution);
    __m512d t = _mm512_div_pd(_mm512_sub_pd(face, start), d);
    t = _mm512_min_pd(_mm512_max_pd(t, zero), _mm512_set1_pd(1.0));
    __m512i next = _mm512_cvttpd_epi64(_mm512_mul_pd(t, end_time));
    __m512i delta =
        _mm512_cvttpd_epi64(_mm512_mul_pd(_mm512_div_pd(resolution, _mm512_abs_pd(d)), end_time));
    delta = _mm512_mask_add_epi64(delta, _mm512_cmpeq_epi64_mask(crossings, one), end, one);
    const __m512i beyond = _mm512_add_epi64(next, _mm512_mullo_epi64(crossings, delta));
    const __mmask8 crosses = _mm512_test_epi64_mask(crossings, crossings);
    rounded |= _mm512_mask_cmple_epi64_mask(crosses, beyond, end);
    rounded |= _mm512_mask_cmpgt_epi64_mask(crosses, _mm512_sub_epi64(beyond, delta), end);
    next = _mm512_mask_mov_epi64(_mm512_set1_epi64(std::numeric_limits<std::int64_t>::max()),
                                 crosses, next);
    delta = _mm512_maskz_mov_epi64(crosses, delta);
    const __m512i move = _mm512_set1_epi64(packed_voxel::kOneOf[axis]);
    steps = _mm512_add_epi64(steps, crossings);
    _mm512_store_si512(rays.t[a].data(), next);
    _mm512_store_si512(rays.dt[a].data(), delta);
    _mm512_store_si512(
        rays.move[a].data(),
        _mm512_mask_mov_epi64(_mm512_sub_epi64(_mm512_setzero_si512(), move), up, move));
  }
  PackedVoxel at = 0;
  for (int axis = 0; axis < 3; ++axis) at += (first - corner)[axis] * packed_voxel::kOneOf[axis];
  _mm512_store_si512(rays.at.data(), _mm512_set1_epi64(at));
  _mm512_store_si512(rays.steps.data(), steps);
  for (; rounded != 0; rounded &= rounded - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(rounded));
    rays.set(lane, VoxelWalk(from, ends[std::min(lane, ends.size() - 1)], resolution_m), corner);
  }
}

CANOPEER_TARGET_AVX512 void walk_rays_avx512(const RayLanes& rays, std::size_t voxels,
                                             const RaySteps& out) {
  __m512i at = _mm512_load_si512(rays.at.data()), run = _mm512_setzero_si512();
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
    const __m512i bit = _mm512_or_si512(
        _mm512_and_si512(at, _mm512_set1_epi64(kMaskX)),
        _mm512_and_si512(_mm512_srli_epi64(at, kShiftY), _mm512_set1_epi64(kMaskY)));
    run = _mm512_or_si512(run, _mm512_sllv_epi64(_mm512_set1_epi64(1), bit));
    _mm512_store_si512(out.at + place, at);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(out.slice + place),
                     _mm512_cvtepi64_epi8(_mm512_and_si512(_mm512_srli_epi64(at, kShiftZ),
                                                           _mm512_set1_epi64(kBlockSide - 1))));
    _mm512_store_si512(out.run + place, run);
    const __m512i before = at;
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
    const __m512i change = _mm512_xor_si512(at, before);
    const __mmask8 leaves = _mm512_test_epi64_mask(change, _mm512_set1_epi64(kSlicePart));
    run = _mm512_maskz_mov_epi64(static_cast<__mmask8>(~leaves), run);
    out.leaves_slice[step] = static_cast<std::uint8_t>(leaves);
    out.leaves_block[step] =
        static_cast<std::uint8_t>(_mm512_test_epi64_mask(change, _mm512_set1_epi64(kBlockPart)));
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

std::size_t turn_to_rows(const std::uint8_t* lanes, std::size_t steps, std::uint64_t* rows) {
  const std::size_t words = (steps + 63) / 64;
  static_assert(std::endian::native == std::endian::little);
  for (std::size_t eight = 0; 8 * eight < steps; ++eight) {
    std::uint64_t m = 0;
    std::memcpy(&m, lanes + 8 * eight, sizeof m);
    m = transposed(m);
    auto* const bytes = reinterpret_cast<std::uint8_t*>(rows) + eight;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      bytes[lane * words * 8] = static_cast<std::uint8_t>(m >> (8 * lane));
    }
  }
  return words;
}

StartRays start_rays_kernel([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return start_rays_avx512;
#endif
  return start_rays_scalar;
}

WalkRays walk_rays_kernel([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_EACH_LEVEL(level, walk_rays);
}

}  // namespace canopeer
