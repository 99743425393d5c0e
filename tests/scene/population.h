#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "canopeer/scene/plants/plant.h"

namespace canopeer::test {

/// Values seen, one after the other.
class Sample {
 public:
  void add(double value) { values_.push_back(value); }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] double mean() const;
  [[nodiscard]] double sd() const;
  [[nodiscard]] double quantile(double rank) const;

 private:
  std::vector<double> values_;
};

constexpr std::array<double, 9> kTipRows = {0.02, 0.05, 0.08, 0.12, 0.20, 0.30, 0.40, 0.55, 0.80};
constexpr int kAngleBins = 9;
constexpr int kLayers = 11;

/// Leaves of one row of the table of distances from the tip.
struct LeafSamples {
  Sample length_cm, width_cm, petiole_cm, petiole_pitch_deg, blade_pitch_deg, normal_deg, area_cm2;
};

/// What was measured on a population of plants; figures as they are defined for the measured
/// plants.
struct Population {
  std::map<int, Sample> height_m, leaf_count, leaf_area_m2;  // by kind
  std::array<LeafSamples, kTipRows.size()> leaves;
  std::array<double, kAngleBins> angle_share{};          // of leaf area, by normal from vertical
  std::array<Sample, kAngleBins> angle_share_of_leaf{};  // the same leaf by leaf, for its spread
  double mean_angle_deg = 0.0;
  std::map<int, std::array<Sample, kLayers>> density_m2_m3;  // by kind, a value per plant
  Sample width_to_length, blade_area_share, chord_to_arc, normal_deviation_deg;
  Sample length_mm, diameter_mm, narrow_mm, hull_cm3;  // ripe and turning fruits
  Sample green_length_mm, green_diameter_mm;
  Sample fruit_height_m, shoot_distance_cm, tilt_deg, neighbour_cm, volume_share;
  int fruits = 0;
  int minus_x_fruits = 0;
};

/// Grows `each` plants of every kind 3 … 9. Leaves are measured on kinds 3–6, as in the sample.
Population grow_population(int each);

}  // namespace canopeer::test
