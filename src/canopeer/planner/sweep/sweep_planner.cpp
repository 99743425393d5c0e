#include "canopeer/planner/sweep/sweep_planner.h"

#include <utility>

#include "canopeer/geometry/state_archive.h"

namespace canopeer {

SweepPlanner::SweepPlanner(const SweepOptions& options) : options_(options) {}

void SweepPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  mover_ = std::make_unique<ViewMover>(scene, options_.motion);
  views_ = serpentine(scene.segment, options_.scan);
  next_ = 0;
}

void SweepPlanner::moved(const PlanningScene& scene) {
  scene_ = scene;
  mover_->moved(scene);
}

Decision SweepPlanner::decide(const Configuration& q, WorkMeter& work) {
  std::vector<Configuration> way = stretch_from(q, work);
  if (way.size() > 1) {
    Decision decision;
    decision.action = Decision::Action::move;
    decision.motion.T_world_camera =
        scene_.segment.T_world_base * scene_.robot->T_base_camera(way.back());
    decision.motion.waypoints = std::move(way);
    return decision;
  }
  // No straight way to the next point, or from where the arm is.
  while (const auto goal = reach_next(q, work)) {
    ++next_;
    if (auto decision = mover_->go(q, *goal, TargetKind::none, work)) return *decision;
  }
  Decision done;
  done.action = Decision::Action::done;
  return done;
}

/// From `q` through the next points, as far as straight motions are free and a stretch is long.
std::vector<Configuration> SweepPlanner::stretch_from(const Configuration& q, WorkMeter& work) {
  std::vector<Configuration> way = {q};
  double length_m = 0.0;
  while (length_m < options_.stretch_m) {
    const auto goal = reach_next(way.back(), work);
    if (!goal) break;
    int checked = 0;
    const bool free = scene_.checker->edge_free(way.back(), *goal, &checked);
    work.add(Work::state_check, checked);
    if (!free) break;
    length_m += (camera_base(*goal) - camera_base(way.back())).norm();
    way.push_back(*goal);
    ++next_;
  }
  return way;
}

/// A configuration for the next point; those out of reach are passed over. Nothing: there is none
/// left.
std::optional<Configuration> SweepPlanner::reach_next(const Configuration& near, WorkMeter& work) {
  for (; next_ < views_.size(); ++next_) {
    work.add(Work::candidate);
    const FixedView& view = views_[next_];
    auto goal = mover_->reach(scene_.segment.T_world_base * view.camera_base,
                              scene_.segment.T_world_base * view.target_base, near, work);
    if (goal) return goal;
  }
  return std::nullopt;
}

Vec3 SweepPlanner::camera_base(const Configuration& q) const {
  return scene_.robot->T_base_camera(q).translation();
}

Expected<std::string> SweepPlanner::state() const {
  if (!mover_) return fail("no segment has begun");
  return state_bytes(*mover_, next_);
}

Expected<void> SweepPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  return read_state_bytes(state, *mover_, next_);
}

}  // namespace canopeer
