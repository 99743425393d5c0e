#include "canopeer/mission/perception.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "canopeer/base/check.h"

namespace canopeer {

namespace {

/// Against the right labels of the frame, where there is depth; none: it has no labels.
std::optional<PixelCounts> score_pixels(const RgbdFrame& frame, const Mask& found) {
  const auto& labels = frame.true_labels.width() > 0 ? frame.true_labels : frame.labels;
  if (labels.width() != found.width() || labels.height() != found.height()) return std::nullopt;
  int right = 0;
  int all_found = 0;
  int all_true = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    const int seen = frame.depth.pixels()[i] > 0.0F;
    const int is_found = seen & static_cast<int>(found.pixels()[i] != 0);
    const int is_true = seen & static_cast<int>(counted_fruit(labels.pixels()[i]));
    right += is_found & is_true;
    all_found += is_found;
    all_true += is_true;
  }
  return PixelCounts{right, all_found - right, all_true - right};
}

/// Both sorted, and so is what comes of them.
void add_to(std::vector<BlockKey>& blocks, const std::vector<BlockKey>& more) {
  if (blocks.empty()) {
    blocks = more;
    return;
  }
  std::vector<BlockKey> all;
  all.reserve(blocks.size() + more.size());
  std::set_union(blocks.begin(), blocks.end(), more.begin(), more.end(), std::back_inserter(all));
  blocks = std::move(all);
}

}  // namespace

Perception::Perception(const MissionOptions& options, DetectorRegistry detectors)
    : options_(options),
      detectors_(std::move(detectors)),
      map_(options.map),
      fruits_(options.fruit) {}

void Perception::move_field(const Vec3& base_world, const Box& known_free_world) {
  DistanceFieldOptions around;
  const Vec3 reach = Vec3::Constant(options_.field_reach_m);
  around.world = Box(base_world - reach, base_world + reach);
  around.truncation_m = options_.field_truncation_m;
  if (options_.collision.unknown_blocks) around.to = DistanceTo::occupied_or_unknown;
  around.assumed_free = known_free_world;
  field_.emplace(around, map_.resolution_m());
  field_->rebuild(map_);
  field_behind_.clear();
}

Expected<Observation> Perception::observe(const RgbdFrame& frame, const Box& region_world,
                                          WorkMeter& work, StageTimer& timer) {
  auto sighting = take_in(frame, work, timer);
  if (!sighting) return tl::unexpected(sighting.error());
  return Observation{std::move(sighting->detection), std::move(sighting->fused), sighting->pixels,
                     settle(region_world, work, timer)};
}

Expected<Sighting> Perception::take_in(const RgbdFrame& frame, WorkMeter& work, StageTimer& timer) {
  auto detection = timer.time("detect", [&] { return detect(frame); });
  if (!detection) return tl::unexpected(detection.error());
  Sighting seen;
  seen.detection = std::move(*detection);
  const Mask& fruit = seen.detection.fruit;
  seen.pixels = score_pixels(frame, fruit);
  seen.fused = timer.time("fuse", [&] { return fuse(frame, fruit); });
  add_to(unsettled_, seen.fused.changed);
  add_to(field_behind_, seen.fused.changed);
  timer.time("fruit map", [&] { update_fruits(frame, fruit); });
  work.add(Work::detect_frame);
  work.add(Work::fuse_point, seen.fused.fused_points);
  work.add(Work::fruit_frame);
  return seen;
}

MapChange Perception::settle(const Box& region_world, WorkMeter& work, StageTimer& timer) {
  MapChange change;
  change.blocks = std::exchange(unsettled_, {});
  const std::vector<BlockKey> behind = std::exchange(field_behind_, {});
  timer.time("distance field", [&] { update_distances(behind); });
  change.targets =
      timer.time("targets", [&] { return update_targets(region_world, change.blocks); });
  work.add(Work::field_block, static_cast<std::int64_t>(behind.size()));
  work.add(Work::target_block, static_cast<std::int64_t>(map_.block_keys(region_world).size()));
  return change;
}

Expected<Detection> Perception::detect(const RgbdFrame& frame) {
  if (!detector_) {
    auto detector = detectors_.make(options_.detector);
    if (!detector) return fail_in("detector", detector.error());
    detector_ = std::move(*detector);
  }
  auto detection = detector_->detect(frame);
  if (!detection) return fail_in("detector", detection.error());
  if (detection->fruit.width() != frame.depth.width() ||
      detection->fruit.height() != frame.depth.height()) {
    return fail("detector: its mask must have the size of the depth image, " +
                std::to_string(frame.depth.width()) + " × " + std::to_string(frame.depth.height()) +
                "; it is " + std::to_string(detection->fruit.width()) + " × " +
                std::to_string(detection->fruit.height()));
  }
  return detection;
}

FuseResult Perception::fuse(const RgbdFrame& frame, const Mask& fruit) {
  return canopeer::fuse(map_, frame, fruit, options_.fusion);
}

void Perception::update_distances(const std::vector<BlockKey>& changed) {
  CANOPEER_CHECK(field_.has_value(), "move_field() comes first");
  field_->update(map_, changed);
}

// The map changes in fuse() only, so an index of the same region has missed nothing.
FrontierTargets Perception::update_targets(const Box& region_world,
                                           const std::vector<BlockKey>& changed) {
  const bool kept = frontiers_ && frontiers_->world().min() == region_world.min() &&
                    frontiers_->world().max() == region_world.max();
  if (kept) {
    frontiers_->update(map_, changed);
  } else {
    frontiers_.emplace(region_world, map_.resolution_m()).rebuild(map_);
  }
  return frontiers_->targets();
}

void Perception::update_fruits(const RgbdFrame& frame, const Mask& fruit) {
  fruits_.add(frame, fruit);
  fruits_.update();
}

void Perception::restore(VoxelMap map, FruitMap fruits, std::vector<BlockKey> unsettled) {
  map_ = std::move(map);
  fruits_ = std::move(fruits);
  field_.reset();
  frontiers_.reset();
  unsettled_ = std::move(unsettled);
}

}  // namespace canopeer
