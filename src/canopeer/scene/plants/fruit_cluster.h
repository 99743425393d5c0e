#pragma once

#include <optional>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/scene/plants/fruit_body.h"
#include "canopeer/scene/plants/shoot.h"

namespace canopeer {

/// A fruit that hangs on a plant, plant frame.
struct HangingFruit {
  Ripeness ripeness = Ripeness::ripe;
  FruitForm form;
  Pose T_plant_fruit = Pose::Identity();
  Vec3 pedicel_start = Vec3::Zero();  ///< on the shoot's axis
};

class CanopyCover;

/// Hangs the kind's fruits on its shoots: heights, distance to the shoot and tilt as measured,
/// centres at least 6.9 cm apart, no two bodies touching, none cutting a shoot. The kind's
/// sheltered ones take the best hidden of several places.
std::vector<HangingFruit> hang_fruits(const PlantKind& kind, const std::vector<Shoot>& shoots,
                                      const CanopyCover& cover, Rng& rng);

/// Pedicel as a closed tube from the shoot to the fruit's top.
TriangleMesh make_pedicel(const HangingFruit& fruit);

/// True when p is inside the fruit or within margin_m of it (an outer bound: its box-like hull).
bool touches_fruit(const HangingFruit& fruit, const Vec3& p_plant, double margin_m);

}  // namespace canopeer
