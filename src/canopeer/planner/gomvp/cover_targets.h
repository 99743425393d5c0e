#pragma once

#include <vector>

#include "canopeer/planner/gomvp/gomvp_options.h"

namespace canopeer {

/// A frontier voxel that a path of views is to show.
struct CoverTarget {
  VoxelIndex voxel = VoxelIndex::Zero();
  TargetKind kind = TargetKind::none;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(voxel, kind);
  }
};

/// The targets of one path: one voxel a cell of the grid, ROI first, then occupied, then border. At
/// most `max_targets`; each kind gets its share, and what a kind leaves over goes to those behind
/// it, then to those before it. Of too many every k-th is taken, so that they are spread.
[[nodiscard]] std::vector<CoverTarget> choose_targets(const FrontierTargets& frontiers,
                                                      double resolution_m,
                                                      const GomvpOptions& options);

/// Nothing unknown is left beside it: it is no frontier any more.
[[nodiscard]] bool is_seen(const VoxelMap& map, const CoverTarget& target);

}  // namespace canopeer
