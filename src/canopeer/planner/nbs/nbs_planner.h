#pragma once

#include <memory>

#include "canopeer/planner/nbs/nbs_options.h"
#include "canopeer/planner/vmp/vmp_planner.h"

namespace canopeer {

/// VMP's planner (its graph, its motions) with node-wise beam search (beam_search.h) in place of
/// Algorithm 1. A search looks ahead to the end of the segment, at most `nbs.horizon_s`. When no
/// view fits into what is left it takes the best one within the horizon, since a motion that has
/// begun ends. Departures: docs/method.md.
[[nodiscard]] std::unique_ptr<Planner> make_nbs(const NbsOptions& options, const VmpOptions& vmp);

}  // namespace canopeer
