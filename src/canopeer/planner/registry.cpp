#include "canopeer/planner/registry.h"

#include <string>
#include <utility>

#include "canopeer/planner/gomvp/gomvp_finder.h"
#include "canopeer/planner/nbs/nbs_planner.h"
#include "canopeer/planner/nbv/nbv_planner.h"
#include "canopeer/planner/vmp_released/vmp_released.h"

namespace canopeer {

PlannerRegistry PlannerRegistry::built_in() {
  PlannerRegistry all;
  // A planner's source and departures are in its own folder.
  all.put("vmp", "Graph-based view motion planning (Zaenker et al. 2023)",
          [](const PlannerOptions& o) { return std::make_unique<VmpPlanner>(o.vmp); });
  all.put("vmp_released", "the same as its published code behaves",
          [](const PlannerOptions& o) { return make_vmp_released(o.vmp); });
  all.put("gomvp_recon",
          "the least motion that sees all targets (GO-VMP, Jose et al. 2025), reconstructed",
          [](const PlannerOptions& o) {
            return make_gomvp(o.vmp, o.gomvp, InspectionProblem::Objective::cover);
          });
  all.put("gomvp_t", "the same within the time left: what sees most (coverage orienteering)",
          [](const PlannerOptions& o) {
            return make_gomvp(o.vmp, o.gomvp, InspectionProblem::Objective::orienteering);
          });
  all.put("nbs", "node-wise beam search in the graph of vmp (after Qu et al. 2026)",
          [](const PlannerOptions& o) { return make_nbs(o.nbs, o.vmp); });
  all.put("nbv", "the next best view by a published gain (Cuaran et al. 2024)",
          [](const PlannerOptions& o) {
            return std::make_unique<NbvPlanner>(o.nbv, o.vmp.builder.shares, o.vmp.builder.sampler,
                                                o.vmp.path_search.fan);
          });
  all.put("rvp", "the next best view around regions of interest (Zaenker et al. 2021)",
          [](const PlannerOptions& o) { return std::make_unique<RvpPlanner>(o.rvp); });
  all.put("random", "reachable views at random",
          [](const PlannerOptions& o) { return std::make_unique<RandomPlanner>(o.random); });
  all.put("coverage", "a fixed scan, line by line",
          [](const PlannerOptions& o) { return std::make_unique<CoveragePlanner>(o.coverage); });
  all.put("sweep", "the same scan without stops, as fast as frames stay sharp",
          [](const PlannerOptions& o) { return std::make_unique<SweepPlanner>(o.sweep); });
  all.put("drive_by", "the arm parked, the trolley drives along the row",
          [](const PlannerOptions& o) { return std::make_unique<DriveByPlanner>(o.drive_by); });
  all.put("playback", "the views of a plan that a file holds",
          [](const PlannerOptions& o) { return make_playback(o.playback); });
  all.manners_ = {{"sweep", {.keeps_sharp = true}},
                  {"drive_by", {.drives_along_row = true, .keeps_sharp = true}}};
  return all;
}

Expected<void> PlannerRegistry::add(std::string name, std::string one_line, Factory factory,
                                    const PlannerManners& manners) {
  auto added = NamedFactories::add(name, std::move(one_line), std::move(factory));
  if (added) manners_[std::move(name)] = manners;
  return added;
}

PlannerManners PlannerRegistry::manners(std::string_view name) const {
  const auto found = manners_.find(name);
  return found == manners_.end() ? PlannerManners() : found->second;
}

Expected<std::unique_ptr<Planner>> PlannerRegistry::make(std::string_view name,
                                                         const PlannerOptions& options) const {
  const auto factory = find(name);
  if (!factory) return tl::unexpected(factory.error());
  auto planner = (*factory)(options);
  if (!planner) return fail_in("planner '" + std::string(name) + "'", planner.error());
  if (*planner == nullptr)
    return fail("planner '" + std::string(name) + "': its factory made none");
  return planner;
}

}  // namespace canopeer
