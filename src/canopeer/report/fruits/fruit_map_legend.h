#pragma once

#include <string>
#include <vector>

#include "canopeer/report/fruits/fruit_verdicts.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

struct FruitMapLegend {
  std::string svg;
  double height_px = 0.0;
};

/// Names what is on the map and nothing else, in as many lines as `width_px` asks for.
[[nodiscard]] FruitMapLegend fruit_map_legend(const std::vector<FruitVerdict>& verdicts,
                                              const std::vector<FruitTruth>& truth, int width_px);

}  // namespace canopeer
