#pragma once

#include <span>
#include <vector>

#include "canopeer/fruit/shapes/shape_estimate.h"

namespace canopeer {

/// Where fruits may have their centres: peaks of the surface's votes `centre_vote()`. Mean shift
/// finds them, from the fullest places on. They lie at least min_distance_m apart, and at least
/// min_votes lie near each.
[[nodiscard]] std::vector<Vec3> vote_peaks(std::span<const SurfacePoint> surface,
                                           const ShapePrior& prior, double min_distance_m,
                                           int min_votes);

}  // namespace canopeer
