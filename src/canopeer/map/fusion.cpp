#include "canopeer/map/fusion.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "canopeer/map/fusion/crossed_space.h"
#include "canopeer/map/fusion/end_points.h"
#include "canopeer/map/fusion/frame_kernels.h"
#include "canopeer/map/fusion/free_space.h"
#include "canopeer/map/storage/block_directory.h"
#include "canopeer/map/storage/kept.h"

namespace canopeer {
namespace {

// A voxel that holds an end point is a hit, whatever passes through it; the rest of what is free
// is a miss.
class FrameUpdate {
 public:
  // Takes the blocks that hold end points out of `free`.
  FrameUpdate(const EndPoints& ends, FreeSpace& free, bool segmented)
      : ends_(ends), segmented_(segmented), free_(free), combined_(ends.blocks.size(), false) {
    updates_->clear();
    updates_->reserve(ends.blocks.size());
    const auto with_end_points = [this](BlockKey key, const VoxelMask& miss) {
      const std::uint32_t end = end_points_in(key);
      if (end == BlockDirectory::kFree) return false;
      add(end, miss);
      return true;
    };
    std::erase_if(free_.parts,
                  [&](const FreeBlock& block) { return with_end_points(block.key, block.free); });
    std::erase_if(free_.whole,
                  [&](BlockKey key) { return with_end_points(key, VoxelMask::all()); });
    for (std::uint32_t i = 0; i < ends_.blocks.size(); ++i) {
      if (!combined_[i]) add(i, {});
    }
  }

  FuseResult apply(VoxelMap& map, SimdLevel simd) {
    UpdateResult update = map.apply(*updates_, free_.whole, free_.parts, simd);
    return {ends_.count, update.newly_known, update.updated_voxels, std::move(update.changed)};
  }

 private:
  // Place in ends_.blocks, or kFree. Free space comes chunk by chunk.
  std::uint32_t end_points_in(BlockKey key) {
    if (BlockDirectory::chunk_key(key) != chunk_key_) {
      chunk_key_ = BlockDirectory::chunk_key(key);
      chunk_ = ends_.directory.chunk(key);
    }
    return chunk_ == nullptr ? BlockDirectory::kFree
                             : chunk_->slots[BlockDirectory::place_in_chunk(key)];
  }

  void add(std::uint32_t end, const VoxelMask& miss) {
    const EndPoints::Block& block = ends_.blocks[end];
    combined_[end] = true;
    BlockUpdate& update = updates_->emplace_back();
    update.key = block.key;
    update.hit = block.hit;
    update.miss = miss;
    update.miss -= block.hit;
    if (!segmented_) return;
    update.roi_hit = block.roi;
    update.roi_miss = block.hit;
    update.roi_miss -= block.roi;
    if (!ends_.confidences.empty()) update.roi_confidence = ends_.confidences[end].data();
  }

  const EndPoints& ends_;
  bool segmented_;
  FreeSpace& free_;
  std::vector<bool> combined_;
  Kept<std::vector<BlockUpdate>> updates_;
  BlockKey chunk_key_ = ~BlockKey{0};
  const BlockDirectory::Chunk* chunk_ = nullptr;
};

enum class Mode { projective, exact };

FuseResult fuse_in(Mode mode, VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                   const FusionOptions& options) {
  const FrameKernels& kernels = frame_kernels(options.simd);
  const double resolution_m = map.resolution_m();
  Kept<EndPoints> ends;
  Kept<FreeSpace> free;
  find_end_points(frame, roi, options, resolution_m, kernels, *ends);
  if (mode == Mode::projective) {
    find_free_space(ends->free_depth, frame.intrinsics, frame.T_world_camera, resolution_m, kernels,
                    *free);
  } else {
    find_crossed_space(frame, ends->free_depth, resolution_m, kernels, *free);
  }
  return FrameUpdate(*ends, *free, !roi.empty()).apply(map, options.simd);
}

}  // namespace

FuseResult fuse(VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                const FusionOptions& options) {
  return fuse_in(Mode::projective, map, frame, roi, options);
}

FuseResult fuse_exact(VoxelMap& map, const RgbdFrame& frame, const Mask& roi,
                      const FusionOptions& options) {
  return fuse_in(Mode::exact, map, frame, roi, options);
}

}  // namespace canopeer
