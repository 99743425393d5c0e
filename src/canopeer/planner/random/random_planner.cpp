#include "canopeer/planner/random/random_planner.h"

namespace canopeer {
namespace {

Vec3 uniform_in(const Box& box, Rng& rng) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = rng.uniform(box.min()[i], box.max()[i]);
  return p;
}

}  // namespace

RandomPlanner::RandomPlanner(const RandomOptions& options) : options_(options) {}

void RandomPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  mover_ = std::make_unique<ViewMover>(scene, options_.motion);
  rng_ = Rng(scene.seed, "random views", static_cast<std::uint64_t>(scene.segment.index));
  patience_ = Patience();
}

void RandomPlanner::map_changed(MapChange) {}

Decision RandomPlanner::decide(const Configuration& q, WorkMeter& work) {
  int plans = 0;
  for (int i = 0; i < options_.max_tries && plans < options_.max_plans; ++i) {
    work.add(Work::candidate);
    const Sight sight = draw();
    const auto goal = mover_->reach(sight.camera_world, sight.target_world, q, work);
    if (!goal) continue;
    ++plans;
    if (auto decision = mover_->go(q, *goal, TargetKind::none, work)) {
      patience_.renew();
      return *decision;
    }
  }
  return patience_.hold();
}

RandomPlanner::Sight RandomPlanner::draw() {
  while (true) {
    Sight sight;
    sight.camera_world =
        scene_.segment.T_world_base * uniform_in(scene_.segment.workspace_base, rng_);
    sight.target_world = uniform_in(scene_.segment.sampling_region_world, rng_);
    if ((sight.camera_world - sight.target_world).norm() >= options_.min_target_distance_m) {
      return sight;
    }
  }
}

void RandomPlanner::time_passes(double seconds) { patience_.time_passes(seconds); }

PlannerStatus RandomPlanner::status() const { return {}; }

}  // namespace canopeer
