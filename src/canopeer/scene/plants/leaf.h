#pragma once

#include "canopeer/base/rng.h"
#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

/// Size and posture of one leaf. Pitch is above the horizontal, positive upwards.
struct LeafForm {
  double length_m = 0.16;  ///< of the blade, along the midrib
  double width_m = 0.095;
  double petiole_m = 0.065;
  double petiole_pitch_rad = 0.0;
  double blade_pitch_rad = 0.0;  ///< mean along the midrib
  double azimuth_rad = 0.0;      ///< about z
  double bend_rad = 1.1;         ///< the midrib's pitch falls by this from base to tip; not 0
  double roll_rad = 0.0;         ///< about the midrib
  double twist_rad = 0.0;        ///< further roll from base to tip
  double fold_rad = 0.25;        ///< each half rises from the midrib by this
  double cup = 0.1;              ///< and its margin falls again by this share of the half width
  double ripple_phase_rad = 0.0;
};

/// Draws a leaf that leaves the shoot `below_tip_m` below its tip, by the measured leaf table; the
/// azimuth stays 0. Near the tip leaves stand in pairs: the second one is 0.45 times as long.
LeafForm draw_leaf(double below_tip_m, bool in_pair, bool second, Rng& rng);

/// End of the petiole that starts at `node`.
Vec3 petiole_end(const LeafForm& leaf, const Vec3& node);

/// Curved blade as a single sheet with normals (upper side), from the petiole's end on.
TriangleMesh make_blade(const LeafForm& leaf, const Vec3& base);

/// Petiole as a closed tube from `node` to petiole_end(), and the midrib it becomes in the blade.
TriangleMesh make_petiole(const LeafForm& leaf, const Vec3& node);

}  // namespace canopeer
