#pragma once

#include "canopeer/planner/registry.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// Adds `vmp_true` and `nbs_true`: the same planners with the true gain (true_gain.h) in place of
/// the map's. They are made once tell_truth() has been called on their options; else the error says
/// that only a simulation knows what is really there.
void add_truth_planners(PlannerRegistry& planners);

/// What planners that know the truth are told; the scene is copied.
void tell_truth(const Scene& scene, PlannerOptions& options);

}  // namespace canopeer
