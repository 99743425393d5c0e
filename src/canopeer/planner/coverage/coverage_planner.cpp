#include "canopeer/planner/coverage/coverage_planner.h"

#include "canopeer/geometry/state_archive.h"

namespace canopeer {

CoveragePlanner::CoveragePlanner(const CoverageOptions& options) : options_(options) {}

void CoveragePlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  mover_ = std::make_unique<ViewMover>(scene, options_.motion);
  views_ = serpentine(scene.segment, options_.scan);
  next_ = 0;
}

Decision CoveragePlanner::decide(const Configuration& q, WorkMeter& work) {
  while (next_ < views_.size()) {
    const FixedView& view = views_[next_++];
    work.add(Work::candidate);
    const auto goal = mover_->reach(scene_.segment.T_world_base * view.camera_base,
                                    scene_.segment.T_world_base * view.target_base, q, work);
    if (!goal) continue;
    if (auto decision = mover_->go(q, *goal, TargetKind::none, work)) return *decision;
  }
  Decision done;
  done.action = Decision::Action::done;
  return done;
}

Expected<std::string> CoveragePlanner::state() const {
  if (!mover_) return fail("no segment has begun");
  return state_bytes(*mover_, next_);
}

Expected<void> CoveragePlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  return read_state_bytes(state, *mover_, next_);
}

}  // namespace canopeer
