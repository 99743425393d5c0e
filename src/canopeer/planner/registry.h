#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/base/named_factories.h"
#include "canopeer/planner/coverage/coverage_planner.h"
#include "canopeer/planner/drive_by/drive_by_planner.h"
#include "canopeer/planner/planner.h"
#include "canopeer/planner/random/random_planner.h"
#include "canopeer/planner/rvp/rvp_planner.h"
#include "canopeer/planner/sweep/sweep_planner.h"
#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// In which order the mission's stops, lift heights and sides are worked at.
enum class SegmentOrder {
  by_stop,   ///< each is a segment of its own; the trolley stands still in it
  along_row  ///< all of one side are one segment, in which the planner drives along the row
};

/// The options of every planner; a run uses those of the one it names.
struct PlannerOptions {
  VmpOptions vmp;  ///< vmp_released too, where the published code does not depart from the paper
  RvpOptions rvp;
  RandomOptions random;
  CoverageOptions coverage;
  SweepOptions sweep;
  DriveByOptions drive_by;
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

  /// As NamedFactories::add; `order`: of a planner that drives along the row itself.
  [[nodiscard]] Expected<void> add(std::string name, std::string one_line, Factory factory,
                                   SegmentOrder order = SegmentOrder::by_stop);
  /// How the planner called `name` wants its segments; by_stop where there is none of that name.
  [[nodiscard]] SegmentOrder order_of(std::string_view name) const;

  /// The planner called `name`; the error lists the names there are, or is the factory's.
  [[nodiscard]] Expected<std::unique_ptr<Planner>> make(std::string_view name,
                                                        const PlannerOptions& options) const;

 private:
  PlannerRegistry() : NamedFactories("planner") {}

  std::set<std::string, std::less<>> along_row_;
};

}  // namespace canopeer
