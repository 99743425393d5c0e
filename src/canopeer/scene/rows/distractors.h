#pragma once

#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/scene/plants/plant.h"

namespace canopeer {

/// Reddish things that are no fruit, in turn: a red clip round a stem (about 2 cm), a dry
/// reddish-brown leaf low on the plant, a pink label tied to the stem. Plant frame,
/// ScenePart::plant is 0. Nothing when there is no place clear of the fruits.
std::vector<ScenePart> make_distractor(const Plant& plant, int turn, Rng& rng);

/// Terracotta heating pipe on the ground along y at x.
ScenePart make_pipe(double x_m, double low_y_m, double high_y_m, Rng& rng);

}  // namespace canopeer
