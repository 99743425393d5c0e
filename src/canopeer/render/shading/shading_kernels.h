#pragma once

#include <cstddef>
#include <cstdint>

#include "canopeer/base/simd_level.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Light of a rendering.
struct Light {
  float x = 0.0F, y = 0.0F, z = 1.0F;  ///< unit vector towards it, world
  float ambient = 0.6F;                ///< share that comes from everywhere
};

/// What shading needs of a row of pixels, one array per quantity, `count` long and readable up to a
/// multiple of 16. World frame. Surfaces are lit from both sides.
struct ShadedRow {
  std::size_t count = 0;
  float *ray_x = nullptr, *ray_y = nullptr,
        *ray_z = nullptr;  ///< through the pixel's centre, depth 1
  /// The surface: normal of any length and side, brightness · weight and depth · weight, and the
  /// weight. `orient` makes them a unit vector towards the viewer, brightness and depth.
  float *normal_x = nullptr, *normal_y = nullptr, *normal_z = nullptr;
  float *brightness = nullptr, *depth = nullptr, *weight = nullptr;
  float *red = nullptr, *green = nullptr,
        *blue = nullptr;  ///< base colour, 0 … 255; `light` makes it the colour seen
  float *gloss_wide = nullptr, *gloss_narrow = nullptr;  ///< strength of highlights, grey levels
  float* through = nullptr;  ///< share of light from behind that comes through
  float* lit = nullptr;      ///< 1; 0 in shadow
};
inline constexpr std::size_t kShadedRowArrays = 16;

/// The renderer's loops over a row of pixels for one instruction set. Every level gives the same
/// bits.
struct ShadingKernels {
  /// Rays of a pinhole: first + i · step.
  void (*rays)(const float first[3], const float step[3], const ShadedRow& row);
  void (*orient)(const ShadedRow& row);
  /// Blotches on what lies flat among the pixels begin … end, seen from `eye`.
  void (*blotch)(const float eye[3], std::size_t begin, std::size_t end, const ShadedRow& row);
  void (*light)(const Light& light, const ShadedRow& row);
  /// Seen where no surface is, pixels begin … end.
  void (*sky)(std::size_t begin, std::size_t end, const ShadedRow& row);
  /// Depth where it is in range, else 0.
  void (*store_depth)(const ShadedRow& row, float least, float most, float* depth);
  /// Colour with triangular noise of half width `noise`; pixel i draws its from key + i.
  void (*store_color)(const ShadedRow& row, float noise, std::uint64_t key, Rgb* color);
};

const ShadingKernels& shading_kernels(SimdLevel level);

}  // namespace canopeer
