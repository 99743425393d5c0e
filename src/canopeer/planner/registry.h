#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/base/named_factories.h"
#include "canopeer/planner/coverage/coverage_planner.h"
#include "canopeer/planner/drive_by/drive_by_planner.h"
#include "canopeer/planner/gomvp/gomvp_options.h"
#include "canopeer/planner/nbs/nbs_options.h"
#include "canopeer/planner/nbv/nbv_options.h"
#include "canopeer/planner/planner.h"
#include "canopeer/planner/playback/playback_planner.h"
#include "canopeer/planner/random/random_planner.h"
#include "canopeer/planner/rvp/rvp_planner.h"
#include "canopeer/planner/sweep/sweep_planner.h"
#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// What a mission has to know of a planner before it is made.
struct PlannerManners {
  /// All stops and lift heights of one side are one segment, in which the planner drives along the
  /// row itself; else each is a segment of its own, and the trolley stands still in it.
  bool drives_along_row = false;
  /// Frames on the way are all it lives by: by default it moves no faster than they stay sharp.
  bool keeps_sharp = false;
  /// It is told what is really there, which only a simulation knows: a yardstick, no rival.
  bool knows_truth = false;
};

/// The options of every planner; a run uses those of the one it names.
struct PlannerOptions {
  VmpOptions vmp;  ///< vmp_released too, where the published code does not depart from the paper
  NbsOptions nbs;  ///< with the graph, rays and times of `vmp`
  NbvOptions nbv;  ///< with the view sampling and rays of `vmp`
  RvpOptions rvp;
  RandomOptions random;
  CoverageOptions coverage;
  SweepOptions sweep;
  DriveByOptions drive_by;
  PlaybackOptions playback;
  GomvpOptions gomvp;  ///< gomvp_recon and gomvp_t, on the graph of `vmp`
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

  /// As NamedFactories::add, of a planner with manners of its own.
  [[nodiscard]] Expected<void> add(std::string name, std::string one_line, Factory factory,
                                   const PlannerManners& manners = {});
  /// Those of the planner called `name`; the usual ones where there is none of that name.
  [[nodiscard]] PlannerManners manners(std::string_view name) const;

  /// The planner called `name`; the error lists the names there are, or is the factory's.
  [[nodiscard]] Expected<std::unique_ptr<Planner>> make(std::string_view name,
                                                        const PlannerOptions& options) const;

 private:
  PlannerRegistry() : NamedFactories("planner") {}

  std::map<std::string, PlannerManners, std::less<>> manners_;
};

}  // namespace canopeer
