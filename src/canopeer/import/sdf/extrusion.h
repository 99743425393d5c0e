#pragma once

#include <optional>
#include <vector>

#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

/// A wall of `height_m` along a closed outline in the x–y plane, from z = 0 up, with floor and lid:
/// SDF's <polyline>. The outline may turn either way and be hollow; it closes itself. Nothing when
/// it has fewer than three corners, no area, or crosses itself.
[[nodiscard]] std::optional<TriangleMesh> extruded_mesh(std::vector<Eigen::Vector2d> outline,
                                                        double height_m);

}  // namespace canopeer
