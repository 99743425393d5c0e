#pragma once

#include <cstddef>
#include <string>

#include "canopeer/geometry/voxel_ray.h"

namespace canopeer::octomap_format {

// What OctoMap's files are made of, as its writer (1.6 to 1.9) makes them.

inline constexpr int kTreeDepth = 16;
/// OctoMap's keys are voxel indices plus this.
inline constexpr int kKeyOffset = 1 << (kTreeDepth - 1);
inline constexpr char kFullFirstLine[] = "# Octomap OcTree file";
inline constexpr char kBinaryFirstLine[] = "# Octomap OcTree binary file";

/// `.ot`: a node is its log-odds and a byte that says which children follow.
inline constexpr std::size_t kFullNodeBytes = sizeof(float) + 1;
/// `.bt`: a node with children is two bits for each of them, the first child in the lowest ones.
inline constexpr std::size_t kBinaryNodeBytes = 2;
inline constexpr unsigned kBinaryFree = 1;
inline constexpr unsigned kBinaryOccupied = 2;
inline constexpr unsigned kBinaryInner = 3;

/// Where child i of a node lies within it, in voxels; `level`: tree levels below the node.
inline VoxelIndex child_step(int i, int level) {
  return VoxelIndex(i & 1, i >> 1 & 1, i >> 2) * (1 << (level - 1));
}

}  // namespace canopeer::octomap_format
