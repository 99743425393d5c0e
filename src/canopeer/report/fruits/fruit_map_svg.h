#pragma once

#include <string>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// What a fruit map shows; everything in world coordinates.
struct FruitMapInput {
  std::vector<FruitEstimate> fruits;
  std::vector<FruitTruth> truth;  ///< empty: there is none
  std::vector<Vec3> cameras;      ///< in the order of the views; may be empty
  std::vector<Vec3> on_the_way;   ///< where frames were taken between views
};

/// Front view of each plant row (y to the right, z up) and the view from above (y to the right, x
/// down), one below the other at one scale. Fruits have their size. True ones are rings (dashed:
/// not found); reported ones are filled, coloured by what they turned out to be. `width_px` is what
/// it is meant to be shown at; a row too long for it makes the map wider. A stand-alone one brings
/// its own style and background and can be a file.
[[nodiscard]] std::string fruit_map_svg(const FruitMapInput& input, int width_px, bool stand_alone);

}  // namespace canopeer
