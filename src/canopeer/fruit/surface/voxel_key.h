#pragma once

#include <cstdint>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {

/// A voxel index within ± 2²⁰ as one number.
inline std::uint64_t voxel_key(const VoxelIndex& index) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
  return part(index.x()) << 42U | part(index.y()) << 21U | part(index.z());
}

/// The voxel of a key.
inline VoxelIndex voxel_of_key(std::uint64_t key) {
  const auto part = [](std::uint64_t bits) {
    return static_cast<int>(bits & 0x1FFFFFU) - (1 << 20);
  };
  return {part(key >> 42U), part(key >> 21U), part(key)};
}

}  // namespace canopeer
