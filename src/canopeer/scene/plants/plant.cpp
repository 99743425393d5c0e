#include "canopeer/scene/plants/plant.h"

#include <string>

#include "canopeer/scene/plants/canopy_cover.h"
#include "canopeer/scene/plants/plant_colors.h"

namespace canopeer {
namespace {

ScenePart make_part(TriangleMesh mesh, PartClass kind, Rgb color) {
  ScenePart part;
  part.mesh = std::move(mesh);
  part.kind = kind;
  part.plant = 0;
  part.color = color;
  return part;
}

void add_leaf(const PlacedLeaf& leaf, Rng& rng, Plant* plant) {
  plant->parts.push_back(make_part(make_blade(leaf.form, petiole_end(leaf.form, leaf.node)),
                                   PartClass::leaf, leaf_color(leaf.below_tip_m, rng)));
  plant->parts.push_back(
      make_part(make_petiole(leaf.form, leaf.node), PartClass::stem, stem_color(rng)));
}

void add_fruit(const HangingFruit& hanging, Rng& rng, Plant* plant) {
  const Pose& T = hanging.T_plant_fruit;
  TriangleMesh body;
  body.append(make_fruit_body(hanging.form), T);
  FruitTruth fruit;
  fruit.id = static_cast<int>(plant->fruits.size());
  fruit.ripeness = hanging.ripeness;
  fruit.counted = hanging.ripeness != Ripeness::green;
  fruit.length_m = hanging.form.length_m;
  fruit.diameter_m = hanging.form.diameter_m;
  measure_body(body, &fruit);
  plant->fruits.push_back(fruit);
  plant->hanging.push_back(hanging);

  plant->parts.push_back(
      make_part(std::move(body), PartClass::fruit, fruit_color(hanging.ripeness, rng)));
  plant->parts.back().fruit = fruit.id;
  TriangleMesh calyx;
  calyx.append(make_calyx(hanging.form), T);
  plant->parts.push_back(make_part(std::move(calyx), PartClass::calyx, calyx_color(rng)));
  plant->parts.push_back(make_part(make_pedicel(hanging), PartClass::stem, stem_color(rng)));
}

}  // namespace

Plant grow_plant(const PlantKind& kind, Rng& rng) {
  Plant plant;
  plant.shoots = grow_shoots(kind, rng);
  plant.leaves = place_leaves(kind, plant.shoots, rng);
  const auto fruits = hang_fruits(kind, plant.shoots, CanopyCover(plant.leaves), rng);
  make_room(fruits, rng, &plant.leaves);
  for (const Shoot& shoot : plant.shoots) {
    plant.parts.push_back(make_part(make_tube(shoot.axis, 8), PartClass::stem, stem_color(rng)));
  }
  for (const PlacedLeaf& leaf : plant.leaves) add_leaf(leaf, rng, &plant);
  for (const HangingFruit& fruit : fruits) add_fruit(fruit, rng, &plant);
  return plant;
}

}  // namespace canopeer
