#pragma once

// The renderer's loops over a row of pixels, written once and compiled for each instruction set.
// The including file says what they are called with CANOPEER_SHADING_NAME, and what vectors there
// are with its compile options. Arrays are padded to whole vectors.

#include "canopeer/render/raster/lanes.h"
#include "canopeer/render/shading/shading_kernels.h"

namespace canopeer {
namespace {

constexpr float kDirect = 1.4F;  // brightness of a surface square to the light, without ambient
// Off the highlight it is less than 1e-6 grey levels; its powers would be denormal numbers, which
// are slow.
constexpr float kDull = 0.1F;

/// Lane i: first + i.
Ints counting(std::size_t first) {
  Ints count;
  for (int i = 0; i < kLanes; ++i) count[i] = static_cast<std::int32_t>(first) + i;
  return count;
}
Floats to_floats(Ints x) { return __builtin_convertvector(x, Floats); }
Ints to_ints(Floats x) { return __builtin_convertvector(x, Ints); }
Floats positive(Floats x) { return most(x, Floats{}); }

void rays(const float first[3], const float step[3], const ShadedRow& row) {
  for (std::size_t i = 0; i < row.count; i += kLanes) {
    const Floats along = to_floats(counting(i));
    store(all(first[0]) + along * all(step[0]), row.ray_x + i);
    store(all(first[1]) + along * all(step[1]), row.ray_y + i);
    store(all(first[2]) + along * all(step[2]), row.ray_z + i);
  }
}

void orient(const ShadedRow& row) {
  for (std::size_t i = 0; i < row.count; i += kLanes) {
    const Floats by_weight = 1.0F / load(row.weight + i);
    store(load(row.brightness + i) * by_weight, row.brightness + i);
    store(load(row.depth + i) * by_weight, row.depth + i);
    const Floats x = load(row.normal_x + i);
    const Floats y = load(row.normal_y + i);
    const Floats z = load(row.normal_z + i);
    const Floats length = root((x * x + y * y) + z * z);
    const Floats unit = 1.0F / most(length, all(1e-30F));
    const Floats away =
        (x * load(row.ray_x + i) + y * load(row.ray_y + i)) + z * load(row.ray_z + i);
    const Floats turned = away > 0.0F ? -unit : unit;
    store(x * turned, row.normal_x + i);
    store(y * turned, row.normal_y + i);
    store(z * turned, row.normal_z + i);
  }
}

/// −1 … 1 at a point of the integer grid.
Floats lattice_noise(Words i, Words j) {
  Words h = i * 0x9e3779b1U + j * 0x85ebca77U;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return to_floats(reinterpret_cast<Ints>((h ^ (h >> 15)) >> 8)) * 0x1.0p-23F - 1.0F;
}

/// Value noise over x and y, −1 … 1.
Floats blotches(Floats x, Floats y, float cells_per_m) {
  x *= cells_per_m;
  y *= cells_per_m;
  const Floats i = floor_of(x);
  const Floats j = floor_of(y);
  const Floats s = x - i;
  const Floats t = y - j;
  const auto a = reinterpret_cast<Words>(to_ints(i));
  const auto b = reinterpret_cast<Words>(to_ints(j));
  return (1.0F - t) * ((1.0F - s) * lattice_noise(a, b) + s * lattice_noise(a + 1U, b)) +
         t * ((1.0F - s) * lattice_noise(a, b + 1U) + s * lattice_noise(a + 1U, b + 1U));
}

void blotch(const float eye[3], std::size_t begin, std::size_t end, const ShadedRow& row) {
  for (std::size_t i = begin; i < end; i += kLanes) {
    const Floats x = eye[0] + load(row.depth + i) * load(row.ray_x + i);
    const Floats y = eye[1] + load(row.depth + i) * load(row.ray_y + i);
    const Floats even = (1.0F + 0.05F * blotches(x, y, 66.0F)) + 0.05F * blotches(x, y, 9.0F);
    const Ints flat =
        (load(row.normal_z + i) > 0.5F) & (counting(i) < static_cast<std::int32_t>(end));
    store(flat ? even : load(row.brightness + i), row.brightness + i);
  }
}

void light(const Light& from, const ShadedRow& row) {
  const Floats lx = all(from.x), ly = all(from.y), lz = all(from.z);
  const Floats ambient = all(from.ambient), direct = all(kDirect * (1.0F - from.ambient));
  for (std::size_t i = 0; i < row.count; i += kLanes) {
    const Floats nx = load(row.normal_x + i);
    const Floats ny = load(row.normal_y + i);
    const Floats nz = load(row.normal_z + i);
    const Floats brightness = load(row.brightness + i);
    const Floats lit = load(row.lit + i);
    const Floats facing = (nx * lx + ny * ly) + nz * lz;
    const Floats sky = ambient * (0.85F + 0.35F * nz);  // more comes from above
    const Floats sun = direct * lit;
    const Floats even = brightness * (sky + sun * positive(facing));
    const Floats behind = brightness * (positive(-facing) * load(row.through + i) * sun);

    // The highlight is brightest where the normal is half way between the light and the viewer.
    const Floats dx = load(row.ray_x + i);
    const Floats dy = load(row.ray_y + i);
    const Floats dz = load(row.ray_z + i);
    const Floats by_ray = 1.0F / root((dx * dx + dy * dy) + dz * dz);
    const Floats hx = lx - dx * by_ray;
    const Floats hy = ly - dy * by_ray;
    const Floats hz = lz - dz * by_ray;
    const Floats by_half = 1.0F / most(root((hx * hx + hy * hy) + hz * hz), all(1e-6F));
    const Floats cosine = ((nx * hx + ny * hy) + nz * hz) * by_half;
    const Floats mirror = cosine > kDull ? cosine : Floats{};
    const Floats to_2 = mirror * mirror, to_4 = to_2 * to_2, to_8 = to_4 * to_4;
    const Floats to_16 = to_8 * to_8, to_32 = to_16 * to_16;
    const Floats shine =
        lit * (load(row.gloss_wide + i) * to_8 + load(row.gloss_narrow + i) * to_32);
    const Floats gloss = facing > 0.0F ? shine : Floats{};

    store(load(row.red + i) * (even + 1.1F * behind) + gloss, row.red + i);
    store(load(row.green + i) * (even + 1.25F * behind) + gloss, row.green + i);
    store(load(row.blue + i) * (even + 0.7F * behind) + gloss, row.blue + i);
  }
}

/// A bright overcast sky, paler towards the horizon.
void sky(std::size_t begin, std::size_t end, const ShadedRow& row) {
  for (std::size_t i = begin; i < end; i += kLanes) {
    const Floats dx = load(row.ray_x + i);
    const Floats dy = load(row.ray_y + i);
    const Floats dz = load(row.ray_z + i);
    const Floats height = positive(dz / root((dx * dx + dy * dy) + dz * dz));
    const Ints here = counting(i) < static_cast<std::int32_t>(end);
    const auto mix = [&](float horizon, float zenith, float* to) {
      const Floats color = (1.0F - height) * horizon + height * zenith;
      store(here ? color : load(to + i), to + i);
    };
    mix(222.0F, 176.0F, row.red);
    mix(228.0F, 200.0F, row.green);
    mix(232.0F, 222.0F, row.blue);
  }
}

void store_depth(const ShadedRow& row, float least, float most, float* depth) {
  for (std::size_t i = 0; i < row.count; ++i) {
    const float z = row.depth[i];
    const float near = z >= least ? z : 0.0F;
    depth[i] = z <= most ? near : 0.0F;
  }
}

/// Triangular noise in −1 … 1 from 16 bits.
float triangular(std::uint32_t bits) {
  const auto sum = static_cast<std::int32_t>((bits & 0xff) + ((bits >> 8) & 0xff));
  return static_cast<float>(sum) / 255.0F - 1.0F;
}

std::uint8_t grey_level(float x) {
  const float low = x > 0.0F ? x : 0.0F;
  const float held = low < 255.0F ? low : 255.0F;
  return static_cast<std::uint8_t>(static_cast<std::int32_t>(held + 0.5F));
}

void store_color(const ShadedRow& row, float noise, std::uint64_t key, Rgb* color) {
  constexpr std::size_t kBatch = 64;
  alignas(64) std::uint32_t low[kBatch], high[kBatch];
  alignas(64) std::uint8_t red[kBatch], green[kBatch], blue[kBatch];
  for (std::size_t first = 0; first < row.count; first += kBatch) {
    for (std::size_t i = 0; i < kBatch; ++i) {
      // pixel_hash()
      std::uint64_t x = key + (first + i) + 0x9e3779b97f4a7c15ULL;
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
      x ^= x >> 31;
      low[i] = static_cast<std::uint32_t>(x);
      high[i] = static_cast<std::uint32_t>(x >> 32);
    }
    const std::size_t count = row.count - first < kBatch ? row.count - first : kBatch;
    for (std::size_t i = 0; i < count; ++i) {
      red[i] = grey_level(row.red[first + i] + noise * triangular(low[i]));
      green[i] = grey_level(row.green[first + i] + noise * triangular(low[i] >> 16));
      blue[i] = grey_level(row.blue[first + i] + noise * triangular(high[i]));
    }
    for (std::size_t i = 0; i < count; ++i) color[first + i] = {red[i], green[i], blue[i]};
  }
}

}  // namespace

extern const ShadingKernels CANOPEER_SHADING_NAME;
const ShadingKernels CANOPEER_SHADING_NAME = {rays, orient,      blotch,     light,
                                              sky,  store_depth, store_color};

}  // namespace canopeer
