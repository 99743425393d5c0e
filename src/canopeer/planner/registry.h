#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/planner/planner.h"
#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// The options of every planner; a run uses those of the one it names.
struct PlannerOptions {
  VmpOptions vmp;
};

/// Names a user can choose, in the order they are listed.
std::vector<std::string> planner_names();

/// The planner called `name`; the error lists the names there are.
[[nodiscard]] Expected<std::unique_ptr<Planner>> make_planner(std::string_view name,
                                                              const PlannerOptions& options);

}  // namespace canopeer
