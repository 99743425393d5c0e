#include "population.h"

#include <gtest/gtest.h>

#include <cmath>

// A generated population against the figures measured on the paper's plants: means within 10 %,
// standard deviations within 30 %, or within the measured sample's own error where that is larger
// (1.96 standard errors: 186 leaves of plants 3–6 in nine rows, 28 ripe or turning fruits, 6 green
// ones).

namespace canopeer {
namespace {

using test::Population;
using test::Sample;

constexpr int kEach = 30;  // plants of each of seven kinds: 210 in all
constexpr double kLeaves = 186.0;
constexpr double kRipe = 28.0;
constexpr double kGreen = 6.0;
constexpr double kFruits = 34.0;

const Population& population() {
  static const Population p = test::grow_population(kEach);
  return p;
}

double mean_tolerance(double mean, double sd, double n) {
  return std::max(0.10 * std::abs(mean), 1.96 * sd / std::sqrt(n));
}

double sd_tolerance(double sd, double n) {
  return std::max(0.30 * sd, 1.96 * sd / std::sqrt(2.0 * n));
}

void expect_mean(const Sample& sample, double mean, double sd, double n, const std::string& what) {
  EXPECT_NEAR(sample.mean(), mean, mean_tolerance(mean, sd, n)) << what;
}

void expect_both(const Sample& sample, double mean, double sd, double n, const std::string& what) {
  expect_mean(sample, mean, sd, n, what);
  EXPECT_NEAR(sample.sd(), sd, sd_tolerance(sd, n)) << what << ", standard deviation";
}

TEST(Population, PlantsHaveTheMeasuredHeightsLeafCountsAndLeafAreas) {
  const Population& p = population();
  const std::map<int, std::array<double, 3>> measured = {{3, {0.80, 24, 0.200}},
                                                         {4, {0.77, 37, 0.239}},
                                                         {5, {1.10, 46, 0.287}},
                                                         {6, {0.80, 79, 0.526}}};
  for (const auto& [kind, figures] : measured) {
    const std::string name = "kind " + std::to_string(kind);
    EXPECT_NEAR(p.height_m.at(kind).mean(), figures[0], 0.10 * figures[0]) << name;
    EXPECT_EQ(p.leaf_count.at(kind).mean(), figures[1]) << name;
    EXPECT_NEAR(p.leaf_area_m2.at(kind).mean(), figures[2], 0.10 * figures[2]) << name;
  }
}

struct LeafRow {
  double length_cm, length_sd, width_cm, width_sd, petiole_cm, petiole_pitch, blade_pitch,
      blade_pitch_sd, normal, area_cm2;
};

constexpr std::array<LeafRow, 9> kRows = {{{3.5, 2.1, 2.2, 1.1, 1.1, 66, 49, 27, 63, 8},
                                           {6.6, 2.7, 3.8, 1.4, 2.3, 48, 10, 19, 33, 22},
                                           {7.8, 3.1, 4.6, 1.6, 2.7, 48, 17, 35, 38, 31},
                                           {8.9, 3.4, 5.2, 1.7, 3.1, 35, 1, 38, 40, 39},
                                           {9.6, 3.7, 5.6, 1.9, 3.4, 31, -4, 31, 32, 46},
                                           {16.4, 1.3, 9.0, 1.1, 6.6, 32, -20, 23, 22, 114},
                                           {16.3, 2.4, 9.3, 1.3, 6.5, 12, -37, 23, 35, 118},
                                           {17.1, 2.5, 9.7, 1.4, 6.9, 3, -43, 19, 44, 127},
                                           {16.4, 2.6, 9.5, 1.5, 7.0, -6, -50, 19, 50, 120}}};

TEST(Population, LeavesChangeWithTheDistanceFromTheTipAsMeasured) {
  const Population& p = population();
  double all = 0.0;
  for (const auto& row : p.leaves) all += static_cast<double>(row.length_cm.size());
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const LeafRow& m = kRows[i];
    const test::LeafSamples& s = p.leaves[i];
    // As many leaves as the measured 186 have in this row.
    const double n = kLeaves * static_cast<double>(s.length_cm.size()) / all;
    const std::string row = "up to " + std::to_string(test::kTipRows[i]) + " m below the tip: ";
    expect_both(s.length_cm, m.length_cm, m.length_sd, n, row + "length");
    expect_both(s.width_cm, m.width_cm, m.width_sd, n, row + "width");
    expect_mean(s.petiole_cm, m.petiole_cm, s.petiole_cm.sd(), n, row + "petiole");
    expect_mean(s.petiole_pitch_deg, m.petiole_pitch, s.petiole_pitch_deg.sd(), n,
                row + "petiole pitch");
    expect_both(s.blade_pitch_deg, m.blade_pitch, m.blade_pitch_sd, n, row + "blade pitch");
    expect_mean(s.normal_deg, m.normal, s.normal_deg.sd(), n, row + "normal");
    expect_mean(s.area_cm2, m.area_cm2, s.area_cm2.sd(), n, row + "area");
  }
}

TEST(Population, BladesHaveTheMeasuredProportions) {
  const Population& p = population();
  expect_both(p.width_to_length, 0.59, 0.07, kLeaves, "width / length");
  expect_mean(p.blade_area_share, 0.73, 0.0, kLeaves, "area / (length · width)");
  expect_mean(p.chord_to_arc, 0.94, 0.0, kLeaves, "chord / arc");
  expect_mean(p.normal_deviation_deg, 22.0, 0.0, kLeaves, "deviation of local normals");
}

TEST(Population, LeavesTurnTowardsTheSkyAsMeasured) {
  const Population& p = population();
  constexpr std::array<double, test::kAngleBins> kShare = {0.052, 0.133, 0.168, 0.165, 0.132,
                                                           0.118, 0.089, 0.074, 0.069};
  for (std::size_t i = 0; i < kShare.size(); ++i) {
    EXPECT_NEAR(p.angle_share[i], kShare[i],
                mean_tolerance(kShare[i], p.angle_share_of_leaf[i].sd(), kLeaves))
        << "from " << 10 * i << "°";
  }
  EXPECT_NEAR(p.mean_angle_deg, 42.0, 4.2);
}

TEST(Population, LeafAreaIsAsDenseInEveryLayerAsMeasured) {
  const Population& p = population();
  constexpr std::array<double, test::kLayers> kDensity = {0.63, 1.30, 1.77, 2.01, 1.65, 1.50,
                                                          1.82, 0.85, 0.47, 0.38, 0.13};
  for (std::size_t l = 0; l < kDensity.size(); ++l) {
    // One measured plant of each of four kinds.
    double mean = 0.0;
    double variance = 0.0;
    for (const auto& [kind, layers] : p.density_m2_m3) {
      mean += layers[l].mean() / 4.0;
      variance += layers[l].sd() * layers[l].sd() / 16.0;
    }
    EXPECT_NEAR(mean, kDensity[l], std::max(0.10 * kDensity[l], 1.96 * std::sqrt(variance)))
        << "layer " << l;
  }
}

TEST(Population, FruitsHaveTheMeasuredSizes) {
  const Population& p = population();
  expect_both(p.length_mm, 74, 11, kRipe, "length");
  expect_both(p.diameter_mm, 68, 11, kRipe, "largest diameter");
  expect_both(p.narrow_mm, 59, 10, kRipe, "smallest diameter");
  expect_both(p.hull_cm3, 171, 77, kRipe, "hull volume");
  expect_both(p.green_length_mm, 51, 8, kGreen, "length of green ones");
  expect_both(p.green_diameter_mm, 43, 11, kGreen, "diameter of green ones");
}

TEST(Population, FruitsHangWhereTheMeasuredOnesDo) {
  const Population& p = population();
  expect_both(p.fruit_height_m, 0.43, 0.13, kFruits, "height");
  expect_both(p.shoot_distance_cm, 5.0, 1.6, kFruits, "distance to the shoot");
  expect_both(p.tilt_deg, 8, 5, kFruits, "tilt");
  // The median's own error is 1.25 times that of the mean.
  EXPECT_NEAR(p.neighbour_cm.quantile(0.5), 9.5,
              1.25 * mean_tolerance(9.5, p.neighbour_cm.sd(), kFruits));
  EXPECT_GE(p.neighbour_cm.quantile(0.0), 6.9);
  // 26 of 34 lie on the −x side; the binomial's error is 0.07.
  EXPECT_NEAR(p.minus_x_fruits / static_cast<double>(p.fruits), 26.0 / 34.0, 0.14);
}

}  // namespace
}  // namespace canopeer
