#include "canopeer/mission/perception.h"

namespace canopeer {

namespace {

/// Against the right labels of the frame, where there is depth; none: it has no labels.
std::optional<PixelCounts> score_pixels(const RgbdFrame& frame, const Mask& found) {
  const auto& labels = frame.true_labels.width() > 0 ? frame.true_labels : frame.labels;
  if (labels.width() != found.width() || labels.height() != found.height()) return std::nullopt;
  Mask truth(found.width(), found.height());
  Mask blind(found.width(), found.height());
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    truth.pixels()[i] = counted_fruit(labels.pixels()[i]);
    blind.pixels()[i] = !(frame.depth.pixels()[i] > 0.0F);
  }
  PixelCounts counts;
  counts.add(found, truth, &blind);
  return counts;
}

}  // namespace

Perception::Perception(const MissionOptions& options)
    : options_(options), map_(options.map), fruits_(options.fruit) {}

void Perception::move_field(const Vec3& base_world, const Box& known_free_world) {
  DistanceFieldOptions around;
  const Vec3 reach = Vec3::Constant(options_.field_reach_m);
  around.world = Box(base_world - reach, base_world + reach);
  around.truncation_m = options_.field_truncation_m;
  if (options_.collision.unknown_blocks) around.to = DistanceTo::occupied_or_unknown;
  around.assumed_free = known_free_world;
  field_.emplace(around, map_.resolution_m());
  field_->rebuild(map_);
}

// The map changes in observe() only, so an index of the same region has missed nothing.
FrontierTargets Perception::targets(const Box& region_world, const std::vector<BlockKey>& changed) {
  const bool kept = frontiers_ && frontiers_->world().min() == region_world.min() &&
                    frontiers_->world().max() == region_world.max();
  if (kept) {
    frontiers_->update(map_, changed);
  } else {
    frontiers_.emplace(region_world, map_.resolution_m()).rebuild(map_);
  }
  return frontiers_->targets();
}

Expected<Observation> Perception::observe(const RgbdFrame& frame, const Box& region_world,
                                          WorkMeter& work, StageTimer& timer) {
  if (!detector_) {
    auto detector = make_detector(options_.detector);
    if (!detector) return fail_in("detector", detector.error());
    detector_ = std::move(*detector);
  }
  const auto found = timer.time("detect", [&] { return detector_->detect(frame); });
  if (!found) return fail_in("detector", found.error());
  const Detection& detection = *found;
  Observation seen;
  seen.pixels = score_pixels(frame, detection.fruit);
  seen.fused =
      timer.time("fuse", [&] { return fuse(map_, frame, detection.fruit, options_.fusion); });
  timer.time("distance field", [&] { field_->update(map_, seen.fused.changed); });
  seen.change.targets =
      timer.time("targets", [&] { return targets(region_world, seen.fused.changed); });
  seen.change.blocks = seen.fused.changed;
  timer.time("fruit map", [&] {
    fruits_.add(frame, detection.fruit);
    fruits_.update();
  });
  work.add(Work::detect_frame);
  work.add(Work::fuse_point, seen.fused.fused_points);
  work.add(Work::field_block, static_cast<std::int64_t>(seen.fused.changed.size()));
  work.add(Work::target_block, static_cast<std::int64_t>(map_.block_keys(region_world).size()));
  return seen;
}

}  // namespace canopeer
