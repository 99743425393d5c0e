#pragma once

#include <memory>
#include <optional>

#include "canopeer/base/compute_cost.h"
#include "canopeer/detect/detector_registry.h"
#include "canopeer/detect/pixel_score.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/frontier_index.h"
#include "canopeer/map/fusion.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/mission/stage_timer.h"
#include "canopeer/planner/planner.h"

namespace canopeer {

/// What a frame showed, before anybody asks what is left to see.
struct Sighting {
  Detection detection;
  FuseResult fused;
  std::optional<PixelCounts>
      pixels;  ///< fruit pixels found against the frame's labels, if it has any
};

/// What one frame taught.
struct Observation {
  Detection detection;
  FuseResult fused;
  std::optional<PixelCounts>
      pixels;  ///< fruit pixels found against the frame's labels, if it has any
  MapChange change;
};

/// From a frame to all that is known: fruit pixels, voxel map, distance field, frontiers, fruit
/// map. observe() takes the five steps; each can be taken alone, in this order for every frame.
/// Where frames come faster than anybody plans, take_in() is for each of them, settle() after some.
class Perception {
 public:
  Perception(const MissionOptions& options, DetectorRegistry detectors);

  /// The robot stands somewhere new: distances are wanted around its base from now on. Where
  /// unknown space blocks, `known_free_world` is free before anything was seen of it.
  void move_field(const Vec3& base_world, const Box& known_free_world = Box());

  /// All five steps. The error is the detector's.
  [[nodiscard]] Expected<Observation> observe(const RgbdFrame& frame, const Box& region_world,
                                              WorkMeter& work, StageTimer& timer);

  /// Steps 1, 2 and 5, which no later frame can do without. The fruit map's work is counted here:
  /// the next frame waits for it. The error is the detector's.
  [[nodiscard]] Expected<Sighting> take_in(const RgbdFrame& frame, WorkMeter& work,
                                           StageTimer& timer);
  /// Steps 3 and 4 for all frames since the last time; its blocks are those that they changed.
  [[nodiscard]] MapChange settle(const Box& region_world, WorkMeter& work, StageTimer& timer);

  /// 1. Which pixels show fruit. The detector is made with the first frame.
  [[nodiscard]] Expected<Detection> detect(const RgbdFrame& frame);
  /// 2. What the frame says of free and occupied space and of regions of interest.
  FuseResult fuse(const RgbdFrame& frame, const Mask& fruit);
  /// 3. Distances to what is occupied, where blocks have changed.
  void update_distances(const std::vector<BlockKey>& changed);
  /// 4. All targets inside the region. `changed`: all blocks since the last call.
  FrontierTargets update_targets(const Box& region_world, const std::vector<BlockKey>& changed);
  /// 5. Fruits and their shapes.
  void update_fruits(const RgbdFrame& frame, const Mask& fruit);

  /// The run is over: fruits whose refinement was put off get it, all shapes are fitted once more.
  void finish(StageTimer& timer) {
    timer.time("fruit map", [&] { fruits_.update_all(); });
  }

  [[nodiscard]] const VoxelMap& map() const { return map_; }
  /// After move_field().
  [[nodiscard]] const DistanceField& field() const { return *field_; }
  [[nodiscard]] const FruitMap& fruits() const { return fruits_; }

  /// Blocks that frames changed since the last settling, sorted.
  [[nodiscard]] const std::vector<BlockKey>& unsettled() const { return unsettled_; }
  /// Goes on from what was known then; call move_field() after it.
  void restore(VoxelMap map, FruitMap fruits, std::vector<BlockKey> unsettled = {});

 private:
  MissionOptions options_;
  DetectorRegistry detectors_;
  std::unique_ptr<Detector> detector_;  // null before the first frame
  VoxelMap map_;
  std::optional<DistanceField> field_;
  std::optional<FrontierIndex> frontiers_;  // of the region asked for last
  FruitMap fruits_;
  std::vector<BlockKey> unsettled_;     // changed by frames since the last settling
  std::vector<BlockKey> field_behind_;  // the same, or since the field was made anew
};

}  // namespace canopeer
