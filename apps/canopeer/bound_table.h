#pragma once

#include <optional>

#include "canopeer/bounds/pipeline_ceiling.h"
#include "canopeer/bounds/set_cover.h"
#include "canopeer/bounds/visibility_ceiling.h"
#include "canopeer/record/yardstick.h"

namespace canopeer::app {

/// All that `canopeer bound` has to say.
struct BoundResults {
  Yardstick yardstick;
  Ceiling ceiling;
  PoolCover cover;
  FindRule rule;       ///< of bounds
  FindRule plan_rule;  ///< of plans
  std::optional<PipelineCeiling> pipeline;
};

/// A short table on standard output.
void print_bounds(const BoundResults& results);

/// What would make a bound wrong: a result above it, or a ceiling below a result. Says each on
/// standard error; true: all is well.
[[nodiscard]] bool check_bounds(const Yardstick& yardstick);

}  // namespace canopeer::app
