#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/shapes/shape_estimate.h"

namespace canopeer {

/// Where fruits may have their centres: peaks of the surface's votes `centre_vote()`, by mean shift
/// from the fullest places on, at least min_distance_m apart and with at least min_votes near them.
[[nodiscard]] std::vector<Vec3> vote_peaks(std::span<const SurfacePoint> surface,
                                           const ShapePrior& prior, double min_distance_m,
                                           int min_votes);

}  // namespace canopeer
