#pragma once

#include <memory>
#include <optional>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/color_detector.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier_index.h"
#include "canopeer/map/fusion.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/mission/stage_timer.h"
#include "canopeer/planner/planner.h"

namespace canopeer {

/// What one frame taught.
struct Observation {
  FuseResult fused;
  MapChange change;
};

/// From a frame to all that is known: fruit pixels, voxel map, distance field, frontiers, fruit
/// map.
class Perception {
 public:
  explicit Perception(const MissionOptions& options);

  /// The robot stands somewhere new: distances are wanted around its base from now on.
  void move_field(const Vec3& base_world);

  /// Detects, fuses, and brings the targets inside `region_world` up to date. The fruit map, which
  /// nobody plans with, is brought up to date aside: its work is not counted.
  Observation observe(const RgbdFrame& frame, const Box& region_world, WorkMeter& work,
                      StageTimer& timer);

  [[nodiscard]] const VoxelMap& map() const { return map_; }
  [[nodiscard]] const DistanceField& field() const { return *field_; }
  [[nodiscard]] const FruitMap& fruits() const { return fruits_; }

 private:
  FrontierTargets targets(const Box& region_world, const std::vector<BlockKey>& changed);

  MissionOptions options_;
  ColorDetector detector_;
  VoxelMap map_;
  std::optional<DistanceField> field_;
  std::optional<FrontierIndex> frontiers_;  // of the region asked for last
  FruitMap fruits_;
};

}  // namespace canopeer
