#include "canopeer/planner/nbv/nbv_planner.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "canopeer/geometry/state_archive.h"
#include "canopeer/planner/nbv/view_gains.h"

namespace canopeer {
namespace {

double gain_of(NbvGain gain, const GainScene& scene, const Pose& T_world_camera) {
  switch (gain) {
    case NbvGain::uvc:
      return uvc_gain(scene, T_world_camera);
    case NbvGain::uvpc:
      return uvpc_gain(scene, T_world_camera);
    case NbvGain::oae:
      return oae_gain(scene, T_world_camera);
    case NbvGain::osamcep:
      break;
  }
  return osamcep_gain(scene, T_world_camera);
}

}  // namespace

NbvPlanner::NbvPlanner(const NbvOptions& options, const TargetShares& shares,
                       const ViewSamplerOptions& sampler, const ViewFan& fan)
    : options_(options), shares_(shares), sampler_options_(sampler), fan_(fan) {
  fan_.max_unknown_m = std::numeric_limits<double>::infinity();
}

void NbvPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  sampler_.emplace(scene_.segment, *scene_.robot, *scene_.ik, sampler_options_);
  mover_ = std::make_unique<ViewMover>(scene_, options_.motion);
  frontiers_ = {};
  targets_ = {};
  rng_ = Rng(scene.seed, "nbv views", static_cast<std::uint64_t>(scene.segment.index));
  patience_ = Patience();
}

void NbvPlanner::map_changed(MapChange change) {
  frontiers_ = std::move(change.targets);
  look_at_map();
}

/// What follows from map and frontiers.
void NbvPlanner::look_at_map() {
  targets_ = sampler_->targets_in_reach(frontiers_, scene_.map->resolution_m(), shares_);
  const Box& region = scene_.segment.sampling_region_world;
  fruit_.rebuild(*scene_.map,
                 Box(region.min() - Vec3::Constant(0.1), region.max() + Vec3::Constant(0.1)));
}

Decision NbvPlanner::decide(const Configuration& q, WorkMeter& work) {
  std::vector<RatedView> views = draw_views(work);
  rate(views, options_.gain, work);
  const auto worthless = [](const RatedView& view) { return view.gain <= 0.0; };
  if (std::all_of(views.begin(), views.end(), worthless)) rate(views, NbvGain::uvc, work);
  double highest = 1e-12;
  for (const RatedView& view : views) highest = std::max(highest, view.gain);
  const Vec3 camera_now =
      scene_.segment.T_world_base * scene_.robot->T_base_camera(q).translation();
  for (RatedView& view : views) {
    const double way_m = (view.view.T_world_camera.translation() - camera_now).norm();
    view.utility = view.gain / highest - options_.distance_weight * way_m;
  }
  std::stable_sort(views.begin(), views.end(),
                   [](const RatedView& a, const RatedView& b) { return a.utility > b.utility; });
  int plans = 0;
  for (const RatedView& view : views) {
    if (plans++ == options_.max_plans) break;
    auto decision = mover_->go(q, view.view.q, view.view.kind, work);
    if (!decision) continue;
    if (options_.gain == NbvGain::uvc) {
      decision->motion.predicted_gain = static_cast<std::int64_t>(std::llround(view.gain));
    }
    patience_.renew();
    return *decision;
  }
  return patience_.hold();
}

std::vector<NbvPlanner::RatedView> NbvPlanner::draw_views(WorkMeter& work) {
  std::vector<RatedView> views;
  for (int i = 0; i < options_.views && !targets_.empty(); ++i) {
    if (auto view = sampler_->sample(*scene_.map, *scene_.checker, targets_, rng_, work)) {
      views.push_back({std::move(*view)});
    }
  }
  return views;
}

void NbvPlanner::rate(std::vector<RatedView>& views, NbvGain gain, WorkMeter& work) const {
  const GainScene scene{*scene_.map, fruit_, fan_, options_.visibility_cell_m};
  work.add(Work::view_cast, static_cast<std::int64_t>(views.size()));
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    views[i].gain = gain_of(gain, scene, views[i].view.T_world_camera);
  });
}

Expected<std::string> NbvPlanner::state() const {
  if (!mover_) return fail("no segment has begun");
  return state_bytes(frontiers_, *mover_, rng_, patience_);
}

Expected<void> NbvPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  if (auto ok = read_state_bytes(state, frontiers_, *mover_, rng_, patience_); !ok) return ok;
  look_at_map();
  return {};
}

}  // namespace canopeer
