#pragma once

#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/scene/plants/plant_kind.h"
#include "canopeer/scene/plants/tube.h"

namespace canopeer {

/// A stem or a fork: axis points at even steps of arc length from base to tip, plant frame.
struct Shoot {
  std::vector<AxisPoint> axis;
  double length_m = 0.0;
  bool fork = false;

  /// Point and radius at arc length s from the base, 0 ≤ s ≤ length_m.
  [[nodiscard]] AxisPoint at(double s) const;
  /// Arc length at which the shoot first reaches height z, or a negative number when it does not.
  [[nodiscard]] double reach_height(double z) const;
};

/// Stems, then forks: nearly straight, leaning 2–18°, tapering to 0.5 mm at the tip; forks leave at
/// 0.1–0.32 m height.
std::vector<Shoot> grow_shoots(const PlantKind& kind, Rng& rng);

/// Distance from p to the nearest shoot's axis.
double distance_to_shoots(const std::vector<Shoot>& shoots, const Vec3& p);

}  // namespace canopeer
