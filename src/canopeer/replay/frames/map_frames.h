#pragma once

#include <unordered_map>
#include <vector>

#include "canopeer/map/frontier.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/replay/frame.h"

namespace canopeer::frames {

/// What changed of the map and its targets since the last time, block by block.
class MapFrames {
 public:
  /// `map` is looked at where `changed` says; all of it the first time and after missed().
  [[nodiscard]] Frame map(int view, double t_s, const VoxelMap& map,
                          const std::vector<BlockKey>& changed);
  [[nodiscard]] Frame targets(int view, const FrontierTargets& targets);
  /// Changes were not told.
  void missed() { missed_some_ = true; }

 private:
  struct Shown {
    VoxelMask occupied;
    VoxelMask roi;
  };
  struct Aims {
    VoxelMask roi;
    VoxelMask occupied;
    VoxelMask border;
  };
  bool missed_some_ = true;
  std::unordered_map<BlockKey, Shown> shown_;
  std::unordered_map<BlockKey, Aims> aims_;
};

}  // namespace canopeer::frames
