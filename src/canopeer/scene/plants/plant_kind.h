#pragma once

#include "canopeer/base/rng.h"

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

  // Of a crop on strings; the paper's plants stand free.
  double string_m = 0.0;  ///< height of the wire that strings lead the shoots to; 0: none
  /// Fruits hang anywhere between these heights; both 0: at the heights measured on the paper's.
  double fruit_low_m = 0.0;
  double fruit_high_m = 0.0;
  /// Share of the fruits on the −x side of their shoot. The paper's lean that way.
  double minus_x_share = 0.85;
  /// Share of the fruits that grew where leaves hide them best from level views.
  double sheltered = 0.0;
  double light_turn_rad = 0.0;  ///< largest turn of a petiole towards its shoot's aisle
  double droop_rad = 0.0;       ///< large leaves hang this much steeper than the measured ones
};

/// The figures of kind `number`; 1 ≤ number ≤ 9.
PlantKind plant_kind(int number);

/// What sort of plant stands somewhere.
enum class PlantPreset {
  numbered,  ///< one of the nine
  paper,     ///< any of the nine that carries fruit, 3 … 9: sparse
  dense,     ///< a crop on strings, 2–3 m tall, 3 m² of leaves, fruits inside the canopy
  seedling   ///< a young plant like kinds 1 and 2, without fruit
};

/// Draws a plant's figures; `number` is that of a numbered one.
PlantKind draw_plant_kind(PlantPreset preset, int number, Rng& rng);

}  // namespace canopeer
