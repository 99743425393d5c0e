#include "canopeer/mission/perception.h"

namespace canopeer {

Perception::Perception(const MissionOptions& options)
    : options_(options), detector_(options.detector), map_(options.map), fruits_(options.fruit) {}

void Perception::move_field(const Vec3& base_world, const Box& known_free_world) {
  DistanceFieldOptions around;
  const Vec3 reach = Vec3::Constant(options_.field_reach_m);
  around.world = Box(base_world - reach, base_world + reach);
  around.truncation_m = options_.field_truncation_m;
  around.unknown_blocks = options_.collision.unknown_blocks;
  around.assumed_free = known_free_world;
  field_.emplace(around, map_.resolution_m());
  field_->rebuild(map_);
}

Observation Perception::observe(const RgbdFrame& frame, const Box& region_world, WorkMeter& work,
                                StageTimer& timer) {
  const Detection detection = timer.time("detect", [&] { return detector_.detect(frame); });
  Observation seen;
  seen.fused =
      timer.time("fuse", [&] { return fuse(map_, frame, detection.fruit, options_.fusion); });
  timer.time("distance field", [&] { field_->update(map_, seen.fused.changed); });
  seen.change.targets =
      timer.time("targets", [&] { return extract_frontiers(map_, region_world); });
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
