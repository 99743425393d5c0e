#include "canopeer/planner/nbs/nbs_planner.h"

#include <algorithm>

#include "canopeer/planner/nbs/beam_search.h"

namespace canopeer {
namespace {

class BeamFinder : public PathFinder {
 public:
  BeamFinder(const NbsOptions& options, const PathSearchOptions& views)
      : options_(options), views_(views) {}

  ViewPath find(const PathQuery& query, WorkMeter& work) override {
    const double left_s = std::clamp(query.time_left_s, 0.0, options_.horizon_s);
    ViewPath path = search(query, options_, left_s, work);
    if (!path.steps.empty()) return path;
    NbsOptions last = options_;
    last.max_views = 1;
    last.promise = 0.0;
    return search(query, last, options_.horizon_s, work);
  }

 private:
  ViewPath search(const PathQuery& query, const NbsOptions& options, double horizon_s,
                  WorkMeter& work) const {
    return search_beams(*query.graph, query.at, *query.map, views_, options, horizon_s, work);
  }

  NbsOptions options_;
  PathSearchOptions views_;
};

}  // namespace

std::unique_ptr<Planner> make_nbs(const NbsOptions& options, const VmpOptions& vmp) {
  VmpOptions planner = vmp;
  planner.search = VmpOptions::Search::other;
  planner.finder = [options, views = vmp.path_search] {
    return std::make_unique<BeamFinder>(options, views);
  };
  if (options.replan_every_view) planner.look_ahead_rad = 0.0;  // one edge is always taken
  return std::make_unique<VmpPlanner>(planner);
}

}  // namespace canopeer
