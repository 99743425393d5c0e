#pragma once

#include <vector>

#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// The corners of the solid behind all of `planes`: where three of them meet and none of the others
/// cuts off, to a nanometre. Empty: there is no such solid, or it is not bounded.
[[nodiscard]] std::vector<Vec3> corners_of(const std::vector<ShapeMesh::Plane>& planes);

}  // namespace canopeer
