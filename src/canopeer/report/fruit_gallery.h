#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/fruit/fruit_estimate.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// One fruit to be shown: its shape over the points it was fitted to.
struct GalleryFruit {
  FruitEstimate estimate;
  std::vector<Vec3> points;   ///< world
  std::vector<Rgb> colors;    ///< one per point, or none
  std::vector<Vec3> missing;  ///< points of the shape nobody saw
  std::optional<FruitTruth> truth;
  std::string verdict;  ///< in words; empty: not scored
};

/// A sheet of fruits in the given order. Each is seen along x (y to the right) and along y (x to
/// the right), z up, all at one scale. It shows the points in their colours, the fitted shape's
/// outline, and the true fruit's where it is known. `stand_alone`: as a file of its own.
[[nodiscard]] std::string fruit_gallery_svg(const std::vector<GalleryFruit>& fruits, int width_px,
                                            bool stand_alone);

}  // namespace canopeer
