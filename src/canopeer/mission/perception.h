#pragma once

#include <memory>
#include <optional>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/detector.h"
#include "canopeer/detect/pixel_score.h"
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
  std::optional<PixelCounts>
      pixels;  ///< fruit pixels found against the frame's labels, if it has any
  MapChange change;
};

/// From a frame to all that is known: fruit pixels, voxel map, distance field, frontiers, fruit
/// map.
class Perception {
 public:
  explicit Perception(const MissionOptions& options);

  /// The robot stands somewhere new: distances are wanted around its base from now on. Where
  /// unknown space blocks, `known_free_world` is free before anything was seen of it.
  void move_field(const Vec3& base_world, const Box& known_free_world = Box());

  /// Detects, fuses, and brings the targets inside `region_world` up to date. The fruit map, which
  /// nobody plans with, is brought up to date aside: its work is not counted. The error is the
  /// detector's, which is made with the first frame.
  Expected<Observation> observe(const RgbdFrame& frame, const Box& region_world, WorkMeter& work,
                                StageTimer& timer);

  /// The run is over: fruits whose refinement was put off get it, all shapes are fitted once more.
  void finish(StageTimer& timer) {
    timer.time("fruit map", [&] { fruits_.update_all(); });
  }

  [[nodiscard]] const VoxelMap& map() const { return map_; }
  [[nodiscard]] const DistanceField& field() const { return *field_; }
  [[nodiscard]] const FruitMap& fruits() const { return fruits_; }

 private:
  FrontierTargets targets(const Box& region_world, const std::vector<BlockKey>& changed);

  MissionOptions options_;
  std::unique_ptr<Detector> detector_;  // null before the first frame
  VoxelMap map_;
  std::optional<DistanceField> field_;
  std::optional<FrontierIndex> frontiers_;  // of the region asked for last
  FruitMap fruits_;
};

}  // namespace canopeer
