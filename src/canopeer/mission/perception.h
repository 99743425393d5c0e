#pragma once

#include <memory>
#include <optional>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/color_detector.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier.h"
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

  /// The robot stands somewhere new: distances are wanted around its base from now on. Where unknown
  /// space blocks, `known_free_world` is free before anything was seen of it.
  void move_field(const Vec3& base_world, const Box& known_free_world = Box());

  /// Detects, fuses, and re-extracts the targets inside `region_world`. The fruit map, which nobody
  /// plans with, is brought up to date aside: its work is not counted.
  Observation observe(const RgbdFrame& frame, const Box& region_world, WorkMeter& work,
                      StageTimer& timer);

  [[nodiscard]] const VoxelMap& map() const { return map_; }
  [[nodiscard]] const DistanceField& field() const { return *field_; }
  [[nodiscard]] const FruitMap& fruits() const { return fruits_; }

 private:
  MissionOptions options_;
  ColorDetector detector_;
  VoxelMap map_;
  std::optional<DistanceField> field_;
  FruitMap fruits_;
};

}  // namespace canopeer
