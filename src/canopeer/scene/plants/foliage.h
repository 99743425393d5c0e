#pragma once

#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/scene/plants/fruit_cluster.h"
#include "canopeer/scene/plants/leaf.h"
#include "canopeer/scene/plants/shoot.h"

namespace canopeer {

/// A leaf at its place on a shoot, plant frame.
struct PlacedLeaf {
  LeafForm form;
  Vec3 node = Vec3::Zero();
  double below_tip_m = 0.0;
};

/// Places the kind's leaves on its shoots: one a node, pairs near the tips, divergence angles and
/// internodes as measured; sizes are scaled to the kind's leaf area.
std::vector<PlacedLeaf> place_leaves(const PlantKind& kind, const std::vector<Shoot>& shoots,
                                     Rng& rng);

/// Turns leaves away from fruits they would cut.
void make_room(const std::vector<HangingFruit>& fruits, Rng& rng, std::vector<PlacedLeaf>* leaves);

}  // namespace canopeer
