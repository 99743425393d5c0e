#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/world_import.h"

namespace canopeer {

/// Colours that are fruit, in HSV.
struct ColorRange {
  double hue_low_deg = -25.0;  ///< may be below 0 or above `hue_high_deg` − 360: red lies about 0
  double hue_high_deg = 30.0;
  double min_saturation = 0.45;  ///< 0 … 1
  double min_value = 0.2;        ///< 0 … 1

  [[nodiscard]] bool holds(Rgb color) const;
};

/// A scanned plant: one mesh, coloured or not.
struct PlantScan {
  std::string name;
  std::filesystem::path mesh;
  /// Which of its surface is fruit: by colour (vertex colours, texture or material), by a second
  /// mesh in the same frame, or by name patterns. The first two may be given together.
  std::optional<ColorRange> fruit_color;
  std::filesystem::path fruit_mesh;  ///< empty: none
  NamePatternOptions patterns;
  std::optional<ColorRange> counted_color;  ///< of the fruits' mean colour; none: all count
  double unit_m = 1.0;                      ///< a unit of the file in metres
  bool y_up = false;                        ///< the file has y up (glTF says so itself)
  bool ground = true;  ///< put its lowest point at z = 0 and the foot of the stem at x = y = 0
};

/// A scan put somewhere.
struct ScanPlacement {
  int scan = 0;  ///< index
  Vec3 position = Vec3::Zero();
  double yaw_rad = 0.0;
};

/// Scanned plants in rows.
struct ScanRowsOptions {
  std::string name;
  std::vector<PlantScan> scans;
  std::vector<ScanPlacement> plants;
  bool floor = true;
  FruitComponentOptions fruits;
};

/// Builds the world. Errors name the file; what can be done without becomes a notice.
[[nodiscard]] Expected<ImportedScene> place_scans(const ScanRowsOptions& options,
                                                  const ImportProgressCallback& progress = {});

}  // namespace canopeer
