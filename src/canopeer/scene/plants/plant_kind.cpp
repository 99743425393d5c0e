#include "canopeer/scene/plants/plant_kind.h"

#include <array>

#include "canopeer/base/check.h"
#include "canopeer/scene/plants/statistics.h"

namespace canopeer {

PlantKind plant_kind(int number) {
  CANOPEER_CHECK(number >= 1 && number <= 9, "plant kinds go from 1 to 9");
  // number, height, stems, forks, stem radius, shoot length, leaves, leaf area, counted, green.
  // Shape figures of 7–9 are interpolated between measured plants by fruit load.
  static constexpr std::array<PlantKind, 9> kKinds = {{
      {1, 0.36, 2, 0, 0.0046, 0.67, 31, 0.134, 0, 0},
      {2, 0.43, 1, 0, 0.0078, 0.41, 21, 0.127, 0, 0},
      {3, 0.80, 1, 0, 0.0091, 0.78, 24, 0.200, 3, 1},
      {4, 0.77, 1, 1, 0.0094, 1.37, 37, 0.239, 3, 1},
      {5, 1.10, 1, 1, 0.0098, 1.81, 46, 0.287, 5, 0},
      {6, 0.80, 2, 2, 0.0092, 2.63, 79, 0.526, 7, 0},
      {7, 0.95, 1, 1, 0.0098, 1.66, 46, 0.320, 7, 1},
      {8, 0.85, 1, 1, 0.0095, 1.46, 38, 0.255, 3, 2},
      {9, 0.72, 1, 0, 0.0088, 0.70, 22, 0.170, 0, 1},
  }};
  return kKinds[static_cast<std::size_t>(number - 1)];
}

namespace {

PlantKind draw_dense(Rng& rng) {
  PlantKind kind;
  kind.number = 0;
  kind.height_m = rng.uniform(2.0, 2.7);
  kind.stems = 2;
  kind.stem_radius_m = rng.uniform(0.010, 0.012);
  kind.shoot_length_m = 2.0 * (kind.height_m - 0.04);
  kind.leaf_area_m2 = 3.15 * clipped_normal(rng, 1.0, 0.08, 0.8, 1.2);
  // Leaves as large as those of the measured plants' middle and lower shoots, 120 cm², and more.
  kind.leaves = static_cast<int>(kind.leaf_area_m2 / 0.0145);
  kind.counted_fruits = 9 + static_cast<int>(rng.index(5));
  kind.green_fruits = 2 + static_cast<int>(rng.index(3));
  kind.string_m = 3.1;
  kind.fruit_low_m = 0.30;
  kind.fruit_high_m = kind.height_m - 0.55;
  kind.minus_x_share = 0.5;
  // Chosen so that level views hide a quarter of the fruits, which other views show.
  kind.sheltered = 0.75;
  kind.light_turn_rad = 0.7;
  kind.droop_rad = 0.26;
  return kind;
}

PlantKind draw_seedling(Rng& rng) {
  PlantKind kind = plant_kind(1 + static_cast<int>(rng.index(2)));
  const double size = rng.uniform(0.85, 1.15);
  kind.height_m *= size;
  kind.shoot_length_m *= size;
  kind.leaf_area_m2 *= size * size;
  return kind;
}

}  // namespace

PlantKind draw_plant_kind(PlantPreset preset, int number, Rng& rng) {
  switch (preset) {
    case PlantPreset::numbered:
      break;
    case PlantPreset::paper:
      return plant_kind(3 + static_cast<int>(rng.index(7)));
    case PlantPreset::dense:
      return draw_dense(rng);
    case PlantPreset::seedling:
      return draw_seedling(rng);
  }
  return plant_kind(number);
}

}  // namespace canopeer
