#include "canopeer/map/fusion.h"

#include <algorithm>
#include <utility>

#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/map/end_points.h"
#include "canopeer/map/free_space.h"

namespace canopeer {
namespace {

// A voxel that holds an end point is a hit, whatever passes through it; the rest of `free` is a
// miss.
std::vector<BlockUpdate> combine(EndPoints& ends, const std::vector<FreeBlock>& free,
                                 bool segmented) {
  std::vector<BlockUpdate> updates;
  updates.reserve(free.size() + ends.blocks.size());
  std::vector<bool> combined(ends.blocks.size(), false);
  const auto add_end_points = [&](BlockUpdate& update, const EndPoints::Block& block) {
    update.hit = block.hit;
    update.miss -= block.hit;
    if (!segmented) return;
    update.roi_hit = block.roi;
    update.roi_miss = block.hit;
    update.roi_miss -= block.roi;
  };
  for (const FreeBlock& block : free) {
    BlockUpdate& update = updates.emplace_back();
    update.key = block.key;
    update.miss = block.free;
    const auto slot = ends.directory.find(block.key);
    if (!slot) continue;
    add_end_points(update, ends.blocks[*slot]);
    combined[*slot] = true;
  }
  for (std::size_t i = 0; i < ends.blocks.size(); ++i) {
    if (combined[i]) continue;
    BlockUpdate& update = updates.emplace_back();
    update.key = ends.blocks[i].key;
    add_end_points(update, ends.blocks[i]);
  }
  return updates;
}

FuseResult apply(VoxelMap& map, EndPoints& ends, const std::vector<FreeBlock>& free,
                 bool segmented) {
  UpdateResult update = map.apply(combine(ends, free, segmented));
  return {ends.count, update.newly_known, update.updated_voxels, std::move(update.changed)};
}

std::vector<FreeBlock> walk_rays(const RgbdFrame& frame, const DepthImage& free_depth,
                                 double resolution_m) {
  BlockDirectory directory;
  std::vector<FreeBlock> blocks;
  const Vec3 origin = frame.T_world_camera.translation();
  for (int v = 0; v < free_depth.height(); ++v) {
    for (int u = 0; u < free_depth.width(); ++u) {
      const double depth = static_cast<double>(free_depth.at(u, v));
      if (depth <= 0.0) continue;
      const Vec3 end = frame.T_world_camera * (depth * frame.intrinsics.ray(u, v));
      const VoxelIndex last = voxel_at(end, resolution_m);
      walk_voxels(origin, end, resolution_m, [&](const VoxelIndex& voxel) {
        if (voxel == last) return false;
        const BlockKey key = block_key(voxel);
        const std::uint32_t slot = directory.find_or_add(key);
        if (slot == blocks.size()) blocks.push_back({key, {}});
        blocks[slot].free.set(voxel);
        return true;
      });
    }
  }
  return blocks;
}

}  // namespace

FuseResult fuse(VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                const FusionOptions& options) {
  EndPoints ends = find_end_points(frame, roi, options, map.resolution_m());
  const std::vector<FreeBlock> free =
      find_free_space(ends.free_depth, frame.intrinsics, frame.T_world_camera, map.resolution_m());
  return apply(map, ends, free, !roi.empty());
}

FuseResult fuse_exact(VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                      const FusionOptions& options) {
  EndPoints ends = find_end_points(frame, roi, options, map.resolution_m());
  const std::vector<FreeBlock> free = walk_rays(frame, ends.free_depth, map.resolution_m());
  return apply(map, ends, free, !roi.empty());
}

}  // namespace canopeer
