#include "canopeer/planner/registry.h"

#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/planner/vmp_released/vmp_released.h"

namespace canopeer {

PlannerRegistry PlannerRegistry::built_in() {
  PlannerRegistry all;
  const auto add = [&](const char* name, const char* one_line, Factory factory) {
    const auto added = all.add(name, one_line, std::move(factory));
    CANOPEER_CHECK(added.has_value(), "built-in names are good and differ");
  };
  // A planner's source and departures are in its own folder.
  add("vmp", "Graph-based view motion planning (Zaenker et al. 2023)",
      [](const PlannerOptions& o) { return std::make_unique<VmpPlanner>(o.vmp); });
  add("vmp_released", "the same as its published code behaves",
      [](const PlannerOptions& o) { return make_vmp_released(o.vmp); });
  add("rvp", "the next best view around regions of interest (Zaenker et al. 2021)",
      [](const PlannerOptions& o) { return std::make_unique<RvpPlanner>(o.rvp); });
  add("random", "reachable views at random",
      [](const PlannerOptions& o) { return std::make_unique<RandomPlanner>(o.random); });
  add("coverage", "a fixed scan, line by line",
      [](const PlannerOptions& o) { return std::make_unique<CoveragePlanner>(o.coverage); });
  return all;
}

Expected<std::unique_ptr<Planner>> PlannerRegistry::make(std::string_view name,
                                                         const PlannerOptions& options) const {
  const auto factory = find(name);
  if (!factory) return tl::unexpected(factory.error());
  auto planner = (*factory)(options);
  if (!planner) return fail_in("planner '" + std::string(name) + "'", planner.error());
  CANOPEER_CHECK(*planner != nullptr, "a factory gives a planner or an error");
  return planner;
}

}  // namespace canopeer
