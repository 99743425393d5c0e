#include "canopeer/sim/truth_planners.h"

#include <memory>
#include <string>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/sim/true_gain.h"

namespace canopeer {
namespace {

/// The planner `name` of the library, for options that have been told the truth.
void add_true(PlannerRegistry& planners, const std::string& name, const std::string& one_line) {
  auto honest = planners.find(name);
  CANOPEER_CHECK(honest.has_value(), "the planner that is told the truth is a built-in one");
  const auto make = [honest = std::move(*honest)](
                        const PlannerOptions& options) -> Expected<std::unique_ptr<Planner>> {
    if (!options.vmp.path_search.cast) {
      return fail(
          "it plans with what is really there, which only a simulation knows; choose "
          "another planner");
    }
    return honest(options);
  };
  const auto added = planners.add(name + "_true", one_line, make, {.knows_truth = true});
  CANOPEER_CHECK(added.has_value(), "names of planners that know the truth are free");
}

}  // namespace

void add_truth_planners(PlannerRegistry& planners) {
  add_true(planners, "vmp", "vmp that knows which fruit surface a view would show: a yardstick");
  add_true(planners, "nbs", "nbs that knows which fruit surface a view would show: a yardstick");
}

void tell_truth(const Scene& scene, PlannerOptions& options) {
  const auto gain = std::make_shared<TrueGain>(scene, options.vmp.path_search.fan);
  options.vmp.path_search.cast = [gain](const VoxelMap& map, const Pose& T_world_camera) {
    return gain->cast(map, T_world_camera);
  };
}

}  // namespace canopeer
