#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
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
};

/// Names a user can choose, in the order they are listed.
std::vector<std::string> planner_names();

/// The planner called `name`; the error lists the names there are.
[[nodiscard]] Expected<std::unique_ptr<Planner>> make_planner(std::string_view name,
                                                              const PlannerOptions& options);

}  // namespace canopeer
