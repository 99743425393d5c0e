#include "canopeer/planner/random/random_planner.h"

#include "canopeer/geometry/state_archive.h"

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

Expected<std::string> RandomPlanner::state() const {
  if (!mover_) return fail("no segment has begun");
  return state_bytes(*mover_, rng_, patience_);
}

Expected<void> RandomPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  return read_state_bytes(state, *mover_, rng_, patience_);
}

}  // namespace canopeer
