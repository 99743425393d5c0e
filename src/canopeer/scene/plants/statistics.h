#pragma once

#include <span>

#include "canopeer/base/rng.h"

namespace canopeer {

/// A point of a distribution function: a share `rank` of the values lies below `value`.
struct Quantile {
  double rank;  ///< 0 … 1, ascending
  double value;
};

/// Value at `rank`, linear between the given points; ranks outside them give the end values.
double value_at_rank(std::span<const Quantile> quantiles, double rank);

/// Normal, redrawn until within [low, high] (which must hold a fair share of the mass).
double clipped_normal(Rng& rng, double mean, double standard_deviation, double low, double high);

}  // namespace canopeer
