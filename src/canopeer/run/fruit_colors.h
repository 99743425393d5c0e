#pragma once

#include <optional>
#include <string>

#include "canopeer/detect/color_detector.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// What a detector by colour can see of a scene's fruits, before any light falls on them.
struct FruitColors {
  int counted = 0;       ///< fruits that count
  int seen = 0;          ///< of them: those with at least kSeenShare of their surface in a window
  int colorless = 0;     ///< of them: those whose surface is grey or white nearly everywhere
  double passing = 0.0;  ///< share of all their surface, 0 … 1
};

/// This much of a fruit's surface must have a colour of the detector's for it to be found.
inline constexpr double kSeenShare = 0.1;

/// Looks at some hundred places of each fruit's surface: texels, vertex colours or the material's
/// colour. Light only scales colours, so hue and saturation stay what they are here.
[[nodiscard]] FruitColors look_at_fruits(const Scene& scene, const ColorDetectorOptions& detector);

/// A sentence with numbers when fewer than half of the fruits that count can be seen by it, and
/// what to do; nothing: all is well, or no fruit counts.
[[nodiscard]] std::optional<std::string> fruit_color_notice(const Scene& scene,
                                                            const ColorDetectorOptions& detector);

}  // namespace canopeer
