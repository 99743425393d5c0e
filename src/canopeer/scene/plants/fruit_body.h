#pragma once

#include "canopeer/base/rng.h"
#include "canopeer/geometry/triangle_mesh.h"
#include "canopeer/scene/fruit_truth.h"

namespace canopeer {

/// Size and shape of one blocky fruit; its own frame has the axis along z, the calyx at +z.
struct FruitForm {
  double length_m = 0.074;    ///< extent along the axis
  double diameter_m = 0.068;  ///< largest extent across it
  double narrow_m = 0.059;    ///< extent across, square to the largest
  int lobes = 4;              ///< 3 or 4
  double lobe_depth = 0.12;   ///< of the grooves between lobes, share of the radius
  double taper = 0.12;        ///< how much narrower the lower end is, share of the radius
  double lobe_phase_rad = 0.0;
};

/// Draws a form with the measured sizes of green or of ripe and turning fruits.
FruitForm draw_fruit(Ripeness ripeness, Rng& rng);

/// Closed body with normals in the fruit's own frame, its extent along z centred at 0.
TriangleMesh make_fruit_body(const FruitForm& form);

/// Height of the dented top over the frame's origin at the axis: where the pedicel ends.
double fruit_top_m(const FruitForm& form);

/// Calyx: a small closed star of sepals that lies on the top, fruit frame.
TriangleMesh make_calyx(const FruitForm& form);

/// Fills centre, volume and surface from a closed body, in the body's frame.
void measure_body(const TriangleMesh& body, FruitTruth* fruit);

}  // namespace canopeer
