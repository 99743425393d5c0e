#pragma once

#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer {

enum class UpAxis { x, y, z };

/// What a COLLADA file says of its coordinates.
struct ColladaAsset {
  double unit_m = 1.0;    ///< a unit of the file in metres; the unit's name says nothing
  UpAxis up = UpAxis::y;  ///< COLLADA's own default
};

/// Reads the document's first <asset>; without one, or without an element in it, COLLADA's defaults
/// hold. `name` stands for the file in messages. Error: a unit that is no positive number, an axis
/// that is none of X_UP, Y_UP, Z_UP.
[[nodiscard]] Expected<ColladaAsset> parse_collada_asset(std::string_view text,
                                                         const std::string& name);

}  // namespace canopeer
