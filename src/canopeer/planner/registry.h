#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/base/named_factories.h"
#include "canopeer/planner/coverage/coverage_planner.h"
#include "canopeer/planner/planner.h"
#include "canopeer/planner/random/random_planner.h"
#include "canopeer/planner/rvp/rvp_planner.h"
#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// The options of every planner; a run uses those of the one it names.
struct PlannerOptions {
  VmpOptions vmp;  ///< vmp_released too, where the published code does not depart from the paper
  RvpOptions rvp;
  RandomOptions random;
  CoverageOptions coverage;
  /// Of planners registered from outside, as the mission's section `own_planner` has them.
  std::map<std::string, std::string> own;
};

/// The planners there are to choose from, by name. Whoever has a planner of his own adds it:
///
///     PlannerRegistry planners = PlannerRegistry::built_in();
///     auto ok = planners.add("spiral", "Views along a spiral", [](const PlannerOptions& options) {
///       return std::make_unique<SpiralPlanner>(options.own);
///     });
///
/// A factory's error says what of its options is wrong.
class PlannerRegistry
    : public NamedFactories<Expected<std::unique_ptr<Planner>>(const PlannerOptions&)> {
 public:
  /// Those of this library.
  [[nodiscard]] static PlannerRegistry built_in();

  /// The planner called `name`; the error lists the names there are, or is the factory's.
  [[nodiscard]] Expected<std::unique_ptr<Planner>> make(std::string_view name,
                                                        const PlannerOptions& options) const;

 private:
  PlannerRegistry() : NamedFactories("planner") {}
};

}  // namespace canopeer
