#include "canopeer/planner/registry.h"

#include <string>
#include <utility>

#include "canopeer/planner/vmp_released/vmp_released.h"

namespace canopeer {

PlannerRegistry PlannerRegistry::built_in() {
  PlannerRegistry all;
  // A planner's source and departures are in its own folder.
  all.put("vmp", "Graph-based view motion planning (Zaenker et al. 2023)",
          [](const PlannerOptions& o) { return std::make_unique<VmpPlanner>(o.vmp); });
  all.put("vmp_released", "the same as its published code behaves",
          [](const PlannerOptions& o) { return make_vmp_released(o.vmp); });
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
  all.along_row_.insert("drive_by");
  return all;
}

Expected<void> PlannerRegistry::add(std::string name, std::string one_line, Factory factory,
                                    SegmentOrder order) {
  auto added = NamedFactories::add(name, std::move(one_line), std::move(factory));
  if (added && order == SegmentOrder::along_row) along_row_.insert(std::move(name));
  return added;
}

SegmentOrder PlannerRegistry::order_of(std::string_view name) const {
  return along_row_.find(name) == along_row_.end() ? SegmentOrder::by_stop
                                                   : SegmentOrder::along_row;
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
