#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/bounds/view_pool.h"

namespace canopeer {

/// What can be seen at all, from any free configuration sampled: no run sees more, up to what
/// sampling has missed.
struct Ceiling {
  int fruits = 0;          ///< of whose surface enough can be seen (FindRule)
  int fruits_seen = 0;     ///< of which a patch or more can be seen
  double surface = 0.0;    ///< share of the counted fruits' surface, 0 … 1
  std::int64_t views = 0;  ///< sampled
  /// Share of the patches seen by one sample only, over all segments: about the chance that what a
  /// further sample shows is new (Good 1953).
  double seen_once = 0.0;
  std::vector<double> area_cm2;  ///< by FruitTruth::id: what can be seen of it
};
[[nodiscard]] Ceiling ceiling_of(const ViewPool& pool, const FindRule& rule);

/// Seen area of each fruit, by FruitTruth::id up to the last that has patches. `seen`: by patch.
[[nodiscard]] std::vector<double> seen_area_cm2(const FruitPatches& patches,
                                                const std::vector<char>& seen);

}  // namespace canopeer
