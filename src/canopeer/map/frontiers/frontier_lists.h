#pragma once

#include <span>
#include <vector>

#include "canopeer/map/frontier.h"
#include "canopeer/map/frontiers/frontier_masks.h"

namespace canopeer {

/// The voxels of the masks as lists, `keys` and `masks` parallel; in the order of `keys`, within a
/// block z, y, x.
inline FrontierTargets frontier_lists(std::span<const BlockKey> keys,
                                      std::span<const FrontierMasks> masks) {
  FrontierTargets targets;
  const auto fill = [&](std::vector<VoxelIndex>& list, VoxelMask FrontierMasks::*kind) {
    std::size_t size = 0;
    for (const FrontierMasks& block : masks)
      size += static_cast<std::size_t>((block.*kind).count());
    list.resize(size);
    VoxelIndex* next = list.data();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (!(masks[i].*kind).any()) continue;
      for_each_voxel(keys[i], masks[i].*kind, [&](const VoxelIndex& voxel) { *next++ = voxel; });
    }
  };
  fill(targets.roi, &FrontierMasks::roi);
  fill(targets.occupied, &FrontierMasks::occupied);
  fill(targets.border, &FrontierMasks::border);
  return targets;
}

}  // namespace canopeer
