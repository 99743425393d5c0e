#pragma once

#include "canopeer/planner/gomvp/inspection_problem.h"

namespace canopeer {

/// A good path, quickly. Greedy: the view that shows most new weight per second that its cheapest
/// insertion takes, until all is seen or nothing more fits the budget. Views that show nothing of
/// their own go again. Then 2-opt (a stretch the other way round), or-opt (up to three views in a
/// row elsewhere) and a view in place of another, as long as the path's cost falls; where that
/// leaves time, more views. Deterministic.
[[nodiscard]] InspectionPath greedy_path(const InspectionProblem& problem);

/// Only the second half, for a path that is valid already.
[[nodiscard]] InspectionPath improved_path(const InspectionProblem& problem, InspectionPath path);

}  // namespace canopeer
