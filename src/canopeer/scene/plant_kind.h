#pragma once

namespace canopeer {

/// Measured figures of one of the nine plants of the paper's simulation; a grown plant keeps to
/// them. Of plants 7–9 only the fruits were measured: their other figures are of the same sort.
struct PlantKind {
  int number = 3;                ///< 1 … 9
  double height_m = 0.80;        ///< highest leaf or shoot above the stem base
  int stems = 1;                 ///< shoots that leave the ground
  int forks = 0;                 ///< shoots that leave a stem, one a stem at most
  double stem_radius_m = 0.009;  ///< at the base
  double shoot_length_m = 0.8;   ///< of all shoots together
  int leaves = 24;
  double leaf_area_m2 = 0.2;  ///< one side, all leaves
  int counted_fruits = 3;     ///< ripe or turning
  int green_fruits = 1;
};

/// The figures of kind `number`; 1 ≤ number ≤ 9.
PlantKind plant_kind(int number);

}  // namespace canopeer
