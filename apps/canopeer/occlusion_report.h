#pragma once

#include <string>
#include <vector>

#include "canopeer/render/occlusion.h"

namespace canopeer::app {

/// The statistics of PLANTS: shares at the 10th, 50th and 90th percentile of the fruits, and means.
struct OcclusionReport {
  explicit OcclusionReport(const std::vector<FruitVisibility>& fruits);

  struct Spread {
    double p10 = 0.0;
    double p50 = 0.0;
    double p90 = 0.0;
  };
  int fruits = 0;        ///< looked at
  int without_view = 0;  ///< of these: no position is allowed
  Spread best, median, frontal, share_above_30, union_surface;
  double mean_union = 0.0;
  double mean_union_frontal = 0.0;
  /// Share of the fruits that no level position in front shows to 30 %.
  double hidden_from_front = 0.0;
  /// Share of these that some allowed position shows to 30 %; 1 when there are none.
  double hidden_but_reachable = 1.0;
};

/// A table for people, and one JSON object.
[[nodiscard]] std::string as_text(const OcclusionReport& report);
[[nodiscard]] std::string as_json(const OcclusionReport& report);

}  // namespace canopeer::app
