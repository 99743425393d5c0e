#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// Where the robot stands in one segment (a trolley stop, one side, one lift height) and where it
/// may look.
struct SegmentFrame {
  int index = 0;  ///< running number of the segment in the mission
  TrolleyState trolley;
  Pose T_world_base = Pose::Identity();
  Box workspace_base;         ///< camera positions, arm base frame
  Box sampling_region_world;  ///< target positions, world
  Configuration home;         ///< rad
  /// Where the trolley may drive in it, one after the other along the row; empty: it stands.
  std::vector<TrolleyState> row{};
};

}  // namespace canopeer
