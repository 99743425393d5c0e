#include "canopeer/planner/registry.h"

#include <functional>
#include <utility>

#include "canopeer/planner/vmp_released/vmp_released.h"

namespace canopeer {
namespace {

using Factory = std::function<std::unique_ptr<Planner>(const PlannerOptions&)>;

const std::vector<std::pair<std::string, Factory>>& factories() {
  // One line a planner; its source and departures are in its own folder.
  static const std::vector<std::pair<std::string, Factory>> kFactories = {
      {"vmp", [](const PlannerOptions& o) { return std::make_unique<VmpPlanner>(o.vmp); }},
      {"vmp_released", [](const PlannerOptions& o) { return make_vmp_released(o.vmp); }},
      {"rvp", [](const PlannerOptions& o) { return std::make_unique<RvpPlanner>(o.rvp); }},
      {"random", [](const PlannerOptions& o) { return std::make_unique<RandomPlanner>(o.random); }},
      {"coverage",
       [](const PlannerOptions& o) { return std::make_unique<CoveragePlanner>(o.coverage); }},
  };
  return kFactories;
}

}  // namespace

std::vector<std::string> planner_names() {
  std::vector<std::string> names;
  for (const auto& [name, factory] : factories()) names.push_back(name);
  return names;
}

Expected<std::unique_ptr<Planner>> make_planner(std::string_view name,
                                                const PlannerOptions& options) {
  std::string known;
  for (const auto& [known_name, factory] : factories()) {
    if (known_name == name) return factory(options);
    known += (known.empty() ? "" : ", ") + known_name;
  }
  return fail("unknown planner '" + std::string(name) + "'; there is: " + known);
}

}  // namespace canopeer
