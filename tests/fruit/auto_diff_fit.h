#pragma once

#include <span>

#include "canopeer/fruit/shapes/superellipsoid_fit.h"

namespace canopeer::testing_support {

/// What fit_superellipsoid() finds, by Ceres with automatic derivatives: the same cost written
/// point by point from the definition, the same points, starts and stopping rule. The second
/// opinion in tests, and the baseline of the benchmark.
struct AutoDiffFit {
  Superellipsoid body;
  double cost = 0.0;
};

[[nodiscard]] AutoDiffFit auto_diff_fit(std::span<const SurfacePoint> surface,
                                        const FitOptions& options);

}  // namespace canopeer::testing_support
