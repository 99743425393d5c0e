#include "canopeer/replay/frames/map_frames.h"

#include <map>

#include "canopeer/base/byte_order.h"
#include "canopeer/replay/frames/frame_head.h"

namespace canopeer::frames {
namespace {

void append_key(std::string& octets, BlockKey key) {
  const VoxelIndex index = block_index(key);
  for (int i = 0; i < 3; ++i) append_number(octets, static_cast<std::int32_t>(index[i]));
}

void append_voxels(std::string& octets, const VoxelMask& mask) {
  for (const std::uint64_t slice : mask.slices) append_number(octets, slice);
}

bool same(const VoxelMask& a, const VoxelMask& b) { return a.slices == b.slices; }

}  // namespace

Frame MapFrames::map(int view, double t_s, const VoxelMap& map,
                     const std::vector<BlockKey>& changed) {
  std::string octets;
  int blocks = 0;
  for (const BlockKey key : missed_some_ ? map.block_keys() : changed) {
    const BlockMasks* masks = map.block(key);
    if (masks == nullptr) continue;
    Shown& shown = shown_[key];  // empty at first, as is free space
    if (same(shown.occupied, masks->occupied) && same(shown.roi, masks->roi)) continue;
    shown = {masks->occupied, masks->roi};
    append_key(octets, key);
    append_voxels(octets, shown.occupied);
    append_voxels(octets, shown.roi);
    ++blocks;
  }
  missed_some_ = false;
  Json head = head_of("map");
  head["view"] = view;
  head["t_s"] = from_time(t_s);
  head["blocks"] = blocks;
  return frame_of(head, std::move(octets));
}

Frame MapFrames::targets(int view, const FrontierTargets& targets) {
  std::map<BlockKey, Aims> now;  // sorted: the same targets, the same bytes
  for (const VoxelIndex& voxel : targets.roi) now[block_key(voxel)].roi.set(voxel);
  for (const VoxelIndex& voxel : targets.occupied) now[block_key(voxel)].occupied.set(voxel);
  for (const VoxelIndex& voxel : targets.border) now[block_key(voxel)].border.set(voxel);
  for (const auto& [key, aims] : aims_) now.try_emplace(key);  // those that have none any more

  std::string octets;
  int blocks = 0;
  for (const auto& [key, aims] : now) {
    const auto before = aims_.find(key);
    if (before != aims_.end() && same(before->second.roi, aims.roi) &&
        same(before->second.occupied, aims.occupied) && same(before->second.border, aims.border))
      continue;
    append_key(octets, key);
    append_voxels(octets, aims.roi);
    append_voxels(octets, aims.occupied);
    append_voxels(octets, aims.border);
    ++blocks;
    if (aims.roi.any() || aims.occupied.any() || aims.border.any()) {
      aims_[key] = aims;
    } else {
      aims_.erase(key);
    }
  }
  Json head = head_of("targets");
  head["view"] = view;
  head["blocks"] = blocks;
  return frame_of(head, std::move(octets));
}

}  // namespace canopeer::frames
