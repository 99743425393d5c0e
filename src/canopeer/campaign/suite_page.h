#pragma once

#include <string>

#include "canopeer/campaign/comparison.h"
#include "canopeer/campaign/suite_results.h"

namespace canopeer {

/// The page of a run of the suite: one number per planner and protocol, every world, and the
/// comparison of all runs. One file, no script, no network.
[[nodiscard]] std::string suite_page(const SuiteResults& results, const Suite& suite,
                                     const Comparison& comparison);

/// "0.612 [0.55 … 0.67]".
[[nodiscard]] std::string score_text(const SuiteScore& score);

}  // namespace canopeer
