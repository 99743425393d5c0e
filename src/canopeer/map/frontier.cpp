#include "canopeer/map/frontier.h"

#include <tbb/parallel_for.h>

#include "canopeer/map/frontiers/block_surroundings.h"
#include "canopeer/map/frontiers/frontier_lists.h"
#include "canopeer/map/frontiers/frontier_masks.h"
#include "canopeer/map/storage/voxel_bounds.h"

namespace canopeer {

FrontierTargets extract_frontiers(const VoxelMap& map, const Box& world) {
  const VoxelBounds bounds = VoxelBounds::inside(world, map.resolution_m());
  const std::vector<BlockKey> keys = map.block_keys(world);
  if (keys.empty()) return {};
  const SimdLevel simd = best_simd_level();
  const BlockSurroundings around(map, keys);
  std::vector<FrontierMasks> found(keys.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 128), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (!around.has_unknown(keys[i])) continue;
      found[i] = frontier_masks(map, keys[i], around.has_roi(keys[i]), simd);
      const VoxelMask inside = bounds.mask(keys[i]);
      found[i].roi &= inside;
      found[i].occupied &= inside;
      found[i].border &= inside;
    }
  });
  return frontier_lists(keys, found);
}

}  // namespace canopeer
