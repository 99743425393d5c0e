#include "canopeer/scene/plant_kind.h"

#include <array>

#include "canopeer/base/check.h"

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

}  // namespace canopeer
