#pragma once

#include <optional>
#include <span>
#include <string>

#include "canopeer/geometry/pose.h"

namespace canopeer {

/// A row of plants: where it begins and which way it runs, over the ground.
struct PlantRow {
  std::string name = "1";
  Vec3 start = Vec3::Zero();       ///< world; z is the height that heights count from
  Vec3 direction = Vec3::UnitY();  ///< horizontal, unit length
};

/// Where something is, as people in a glasshouse say it.
struct RowPlace {
  std::string row;
  char side = 'L';       ///< 'L' or 'R' of the row's line, looking along it
  double along_m = 0.0;  ///< from the row's start
  double height_m = 0.0;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(row, side, along_m, height_m);
  }
};

/// In the row whose line is nearest; none when there are no rows.
[[nodiscard]] std::optional<RowPlace> place_in_rows(std::span<const PlantRow> rows,
                                                    const Vec3& p_world);

}  // namespace canopeer
