#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/scene/row_world.h"

namespace canopeer {

/// Scenario 1 of the paper: 12 plants in two rows at x = ±0.75 m, 47 ripe or turning fruits.
WorldOptions scenario_1_world();

/// Scenario 2 of the paper: the same on the floor and again on boards 1.25 m higher, 94 counted
/// fruits.
WorldOptions scenario_2_world();

/// A crop on strings: two rows of six plants 2–3 m tall, leaf area index 4 (3 m² a plant on
/// 0.5 × 1.5 m).
WorldOptions dense_1_world();

/// Tighter and longer: two rows of ten plants 0.4 m apart, leaf area index 5.
WorldOptions dense_2_world();

/// Two rows of 200 plants of the paper's sort along 100 m, copies of 21.
WorldOptions row_100m_world();

/// Two rows of young plants.
WorldOptions seedlings_world();

/// Names that named_world() knows.
const std::vector<std::string>& world_names();

/// The world of that name; "empty" has neither plants nor name. Null: there is none.
std::optional<WorldOptions> named_world(const std::string& name);

/// A row of plants along y.
struct PlantedRow {
  double x_m = 0.75;
  double y_from_m = -1.25;
  double spacing_m = 0.5;
  int count = 6;
  double z_m = 0.0;
  PlantPreset preset = PlantPreset::paper;
  std::vector<int> kinds;  ///< in turn, of numbered plants; empty: 3
};

/// Adds its plants to the world.
void add_row(const PlantedRow& row, WorldOptions* options);

}  // namespace canopeer
