#pragma once

#include <vector>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// The voxels view poses aim at, by kind ([Zaenker23] §III). `occupied` and `border` exclude each
/// other; either may share voxels with `roi`. All are free; sorted by block, then z,
/// y, x.
struct FrontierTargets {
  std::vector<VoxelIndex> roi;       ///< an 18-neighbour is ROI and an 18-neighbour is unknown
  std::vector<VoxelIndex> occupied;  ///< a 6-neighbour is occupied and a 6-neighbour is unknown
  std::vector<VoxelIndex> border;    ///< a 6-neighbour is unknown, none is occupied

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(roi, occupied, border);
  }
};

/// Targets whose centres lie in `world` (neighbours may lie outside it). Bitwise on whole blocks,
/// blocks in parallel. From scratch; FrontierIndex keeps them up to date.
FrontierTargets extract_frontiers(const VoxelMap& map, const Box& world);

}  // namespace canopeer
