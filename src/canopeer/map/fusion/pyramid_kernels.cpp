#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>

#include "canopeer/map/fusion/frame_kernel_parts.h"
#include "canopeer/map/storage/kernel_targets.h"

namespace canopeer {
namespace {

constexpr float kMost = 65535.0F;  // coarse depth
constexpr float kNearest = 0.05F;  // m; nearer cubes are not decided
constexpr float kPixels = 0.25F;   // to spare, as voxels are projected in single precision
constexpr float kMargin = 1e-5F;   // of depth, for the same reason: this + kShare · depth
constexpr float kShare = 1e-6F;

// Minimum and maximum as the vector instructions have them: no NaN comes here.
template <typename T>
CANOPEER_KERNEL_BODY T least(T a, T b) {
  return a < b ? a : b;
}
template <typename T>
CANOPEER_KERNEL_BODY T most(T a, T b) {
  return a > b ? a : b;
}

CANOPEER_KERNEL_BODY void coarsen_body(const float* depth, std::size_t count, float scale,
                                       std::uint16_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(least(depth[i] * scale, kMost)));
  }
}

CANOPEER_KERNEL_BODY void halve_body(const std::uint16_t* upper, const std::uint16_t* lower,
                                     std::size_t count, std::uint16_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t a = upper[2 * i], b = upper[2 * i + 1];
    const std::uint16_t c = lower[2 * i], d = lower[2 * i + 1];
    out[2 * i] = least(least(a, b), least(c, d));
    out[2 * i + 1] = static_cast<std::uint16_t>(~most(most(a, b), most(c, d)));
  }
}

CANOPEER_KERNEL_BODY void widen_body(const std::uint16_t* upper, const std::uint16_t* lower,
                                     std::size_t shift, std::size_t count,
                                     std::uint16_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = least(least(upper[i], upper[i + shift]), least(lower[i], lower[i + shift]));
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

// What is known of the cubes before any depth is looked up, and the four windows that cover each.
struct CubeWindows {
  using Flags = std::array<std::uint8_t, CubeLanes::kMax>;
  using Places = std::array<std::int32_t, CubeLanes::kMax>;
  using Depths = std::array<float, CubeLanes::kMax>;
  alignas(64) Places place[4];
  alignas(64) Depths near;
  alignas(64) Depths far;
  alignas(64) Flags none{};      // nothing free, whatever the depths
  alignas(64) Flags may_none{};  // nothing free if it lies behind all depths
  alignas(64) Flags may_all{};   // all free if it lies before all depths
  alignas(64) Flags apart{};     // clear of the camera
};

CANOPEER_KERNEL_BODY void find_windows(const FlatPyramid& pyramid, const CubeLanes& cubes,
                                       CubeWindows& windows, PixelRects& rects) {
  const auto width = static_cast<float>(pyramid.width);
  const auto height = static_cast<float>(pyramid.height);
  // The planes through the camera and the image's four sides: x − u/fx · z, for u at a side, has
  // the sign of the side a point lies on, whatever its depth; and likewise y.
  const float left = (0.0F - pyramid.cx) / pyramid.fx, right = (width - pyramid.cx) / pyramid.fx;
  const float upper = (0.0F - pyramid.cy) / pyramid.fy, lower = (height - pyramid.cy) / pyramid.fy;
  float to_left = kMargin, to_right = kMargin, to_upper = kMargin, to_lower = kMargin;
  for (const auto& edge : cubes.edges) {
    to_left += std::abs(edge[0] - left * edge[2]);
    to_right += std::abs(edge[0] - right * edge[2]);
    to_upper += std::abs(edge[1] - upper * edge[2]);
    to_lower += std::abs(edge[1] - lower * edge[2]);
  }
  const float pixel_x = kPixels / pyramid.fx, pixel_y = kPixels / pyramid.fy;
  for (std::size_t i = 0; i < cubes.count; ++i) {
    const float z_low = cubes.z[i] - cubes.half, z_high = cubes.z[i] + cubes.half;
    const float margin = kMargin + kShare * most(z_high, 0.0F);
    const float beside_x = pixel_x * most(z_high, 0.0F), beside_y = pixel_y * most(z_high, 0.0F);
    const bool beside = (cubes.x[i] - left * cubes.z[i] < -to_left - beside_x) |
                        (cubes.x[i] - right * cubes.z[i] > to_right + beside_x) |
                        (cubes.y[i] - upper * cubes.z[i] < -to_upper - beside_y) |
                        (cubes.y[i] - lower * cubes.z[i] > to_lower + beside_y);
    const bool behind = (z_high <= 0.0F) | (z_low >= pyramid.largest + margin);
    const bool apart = z_low >= kNearest;
    // x / z differs from the centre's by (dx − x/z · dz) / (z + dz), and likewise y / z.
    const float by_centre = 1.0F / most(cubes.z[i], kNearest);
    const float by_near = 1.0F / most(z_low, kNearest);
    const float x = cubes.x[i] * by_centre, y = cubes.y[i] * by_centre;
    float wide = 0.0F, high = 0.0F;
    for (const auto& edge : cubes.edges) {
      wide += std::abs(edge[0] - x * edge[2]);
      high += std::abs(edge[1] - y * edge[2]);
    }
    const float du = pyramid.fx * (wide * by_near) + kPixels;
    const float dv = pyramid.fy * (high * by_near) + kPixels;
    const float u = pyramid.fx * x + pyramid.cx, v = pyramid.fy * y + pyramid.cy;
    const float u_low = u - du, u_high = u + du;
    const float v_low = v - dv, v_high = v + dv;
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
    rects.u0[i] = u0;
    rects.v0[i] = v0;
    rects.u1[i] = u1;
    rects.v1[i] = v1;
    windows.near[i] = z_low - margin;
    windows.far[i] = z_high + margin;
    windows.place[0][i] = 2 * (row0 + column0);
    windows.place[1][i] = 2 * (row0 + column1);
    windows.place[2][i] = 2 * (row1 + column0);
    windows.place[3][i] = 2 * (row1 + column1);
    windows.none[i] = (behind | beside | (apart & outside)) ? 1 : 0;
    windows.may_none[i] = (apart & covered) ? 1 : 0;
    windows.apart[i] = apart ? 1 : 0;
    windows.may_all[i] = (apart & inside & covered) ? 1 : 0;
  }
}

// bounds[2 i] and [2 i + 1]: smallest and 65535 − largest coarse depth of cube i's windows.
CANOPEER_KERNEL_BODY void look_up(const FlatPyramid& pyramid, const CubeWindows& windows,
                                  std::size_t count, std::uint16_t* bounds) {
  for (std::size_t i = 0; i < count; ++i) {
#if defined(__x86_64__)
    const auto window = [&](std::size_t w) {
      std::int32_t pair = 0;
      __builtin_memcpy(&pair, pyramid.bounds + windows.place[w][i], sizeof pair);
      return _mm_cvtsi32_si128(pair);
    };
    const std::int32_t both = _mm_cvtsi128_si32(
        _mm_min_epu16(_mm_min_epu16(window(0), window(1)), _mm_min_epu16(window(2), window(3))));
    __builtin_memcpy(bounds + 2 * i, &both, sizeof both);
#else
    for (std::size_t which = 0; which < 2; ++which) {
      const auto window = [&](std::size_t w) {
        return pyramid.bounds[static_cast<std::size_t>(windows.place[w][i]) + which];
      };
      bounds[2 * i + which] = least(least(window(0), window(1)), least(window(2), window(3)));
    }
#endif
  }
}

// What depths were rounded down to bounds them from both sides; single precision's error in the
// product is far less than the margin of depth.
CANOPEER_KERNEL_BODY CubeViews classify_body(const FlatPyramid& pyramid, const CubeLanes& cubes,
                                             PixelRects& rects) {
  CubeWindows windows;
  find_windows(pyramid, cubes, windows, rects);
  rects.near = windows.near;
  rects.far = windows.far;
  alignas(64) std::array<std::uint16_t, 2 * CubeLanes::kMax> bounds;
  look_up(pyramid, windows, cubes.count, bounds.data());
  alignas(64) CubeWindows::Flags none{}, all{};
  for (std::size_t i = 0; i < cubes.count; ++i) {
    const auto nearest = static_cast<float>(bounds[2 * i]);
    const float farthest = kMost - static_cast<float>(bounds[2 * i + 1]);
    const bool beyond = windows.near[i] * pyramid.coarse_scale > farthest + 1.0F;
    const bool before = windows.far[i] * pyramid.coarse_scale < nearest;
    none[i] = static_cast<std::uint8_t>(windows.none[i] |
                                        (windows.may_none[i] & static_cast<std::uint8_t>(beyond)));
    all[i] = static_cast<std::uint8_t>((none[i] ^ 1) & windows.may_all[i] &
                                       static_cast<std::uint8_t>(before));
  }
  return {pack_bits<CubeLanes::kMax>(none.data()), pack_bits<CubeLanes::kMax>(all.data()),
          pack_bits<CubeLanes::kMax>(windows.apart.data())};
}

#define CANOPEER_KERNELS(NAME, TARGET)                                                    \
  TARGET void coarsen_##NAME(const float* depth, std::size_t count, float scale,          \
                             std::uint16_t* out) {                                        \
    coarsen_body(depth, count, scale, out);                                               \
  }                                                                                       \
  TARGET void halve_##NAME(const std::uint16_t* upper, const std::uint16_t* lower,        \
                           std::size_t count, std::uint16_t* out) {                       \
    halve_body(upper, lower, count, out);                                                 \
  }                                                                                       \
  TARGET void widen_##NAME(const std::uint16_t* upper, const std::uint16_t* lower,        \
                           std::size_t shift, std::size_t count, std::uint16_t* out) {    \
    widen_body(upper, lower, shift, count, out);                                          \
  }                                                                                       \
  TARGET CubeViews classify_##NAME(const FlatPyramid& pyramid, const CubeLanes& cubes,    \
                                   PixelRects& rects) {                                   \
    return classify_body(pyramid, cubes, rects);                                          \
  }                                                                                       \
  constexpr PyramidKernels kPyramid_##NAME = {coarsen_##NAME, halve_##NAME, widen_##NAME, \
                                              classify_##NAME};

CANOPEER_EACH_LEVEL(CANOPEER_KERNELS)

}  // namespace

PyramidKernels pyramid_kernels([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_LEVEL(level, kPyramid);
}

}  // namespace canopeer
