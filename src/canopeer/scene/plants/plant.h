#pragma once

#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/scene/plants/foliage.h"
#include "canopeer/scene/plants/fruit_cluster.h"
#include "canopeer/scene/plants/plant_kind.h"
#include "canopeer/scene/plants/shoot.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// A sweet pepper plant in its own frame: z up, origin at the stem base. Fruit ids and
/// ScenePart::fruit count from 0 within the plant; ScenePart::plant is 0.
struct Plant {
  std::vector<ScenePart> parts;
  std::vector<FruitTruth> fruits;
  std::vector<Shoot> shoots;
  std::vector<PlacedLeaf> leaves;     ///< in the order of the parts: a blade, then its petiole
  std::vector<HangingFruit> hanging;  ///< hanging[i] is fruits[i]
};

/// Grows a plant whose shoots, leaves and fruits follow the measured distributions. The numbers of
/// leaves and fruits are exactly the kind's. About three quarters of the fruits hang on the −x
/// side; leaf azimuths are uniform.
Plant grow_plant(const PlantKind& kind, Rng& rng);

}  // namespace canopeer
