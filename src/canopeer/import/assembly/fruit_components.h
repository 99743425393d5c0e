#pragma once

#include <span>
#include <vector>

#include "canopeer/import/assembly/convex_hull.h"
#include "canopeer/import/meshes/mesh_piece.h"

namespace canopeer {

/// What hangs together as one fruit.
struct FruitComponentOptions {
  double weld_tolerance_m = 5e-5;  ///< vertices this close are one
  double min_hull_cm3 = 0.5;       ///< what is smaller is a scrap of fruit colour, no fruit
  double inside_margin_m = 2e-3;   ///< a component inside another, to this, is part of it
};

/// The fruits in the fruit-coloured surfaces of one model.
struct FruitComponents {
  /// One fruit: triangles that hang together over welded vertices, and what lies inside them (the
  /// inner shell of a double one, a stone).
  struct Component {
    ConvexHull hull;
    double surface_m2 = 0.0;  ///< of the triangles
  };
  std::vector<Component> components;           ///< in the order of their first triangles
  std::vector<std::vector<int>> component_of;  ///< per piece and triangle; −1: too small to be one
  int scraps = 0;                              ///< components that were too small
};

/// `pieces`: world frame.
[[nodiscard]] FruitComponents find_fruits(std::span<const MeshPiece> pieces,
                                          const FruitComponentOptions& options);

/// Length and largest diameter of a fruit from its hull. Its axis is the long one when there is one
/// that stands out, else the principal axis nearest to the vertical.
struct FruitSize {
  double length_m = 0.0;
  double diameter_m = 0.0;
};
[[nodiscard]] FruitSize measure_fruit(const ConvexHull& hull);

}  // namespace canopeer
