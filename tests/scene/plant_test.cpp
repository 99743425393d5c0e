#include "canopeer/scene/plants/plant.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace canopeer {
namespace {

/// Every edge belongs to exactly two triangles that run along it in opposite directions.
bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++directed[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed) {
    const auto back = directed.find({edge.second, edge.first});
    if (count != 1 || back == directed.end() || back->second != 1) return false;
  }
  return true;
}

double leaf_area(const Plant& plant) {
  double area = 0.0;
  for (const auto& part : plant.parts) {
    if (part.kind == PartClass::leaf) area += part.mesh.area();
  }
  return area;
}

long leaf_count(const Plant& plant) {
  return std::count_if(plant.parts.begin(), plant.parts.end(),
                       [](const ScenePart& part) { return part.kind == PartClass::leaf; });
}

TEST(Plant, KeepsToTheFiguresOfItsKind) {
  for (int number = 1; number <= 9; ++number) {
    const PlantKind kind = plant_kind(number);
    double height = 0.0;
    constexpr int kPlants = 5;
    for (std::uint64_t seed = 0; seed < kPlants; ++seed) {
      Rng rng(seed, "plant", static_cast<std::uint64_t>(number));
      const Plant plant = grow_plant(kind, rng);
      Box box;
      for (const auto& part : plant.parts) box.extend(part.mesh.bounds());
      height += box.max().z() / kPlants;
      EXPECT_EQ(leaf_count(plant), kind.leaves);
      EXPECT_NEAR(leaf_area(plant), kind.leaf_area_m2, 0.1 * kind.leaf_area_m2);
      EXPECT_EQ(plant.fruits.size(),
                static_cast<std::size_t>(kind.counted_fruits + kind.green_fruits));
    }
    EXPECT_NEAR(height, kind.height_m, 0.15 * kind.height_m) << "kind " << number;
  }
}

TEST(Plant, FruitsAreClosedBodiesThatAgreeWithTheGroundTruth) {
  Rng rng(11);
  const Plant plant = grow_plant(plant_kind(7), rng);
  std::size_t bodies = 0;
  for (const auto& part : plant.parts) {
    EXPECT_EQ(part.kind == PartClass::fruit, part.fruit >= 0);
    if (part.fruit < 0) continue;
    ++bodies;
    const FruitTruth& truth = plant.fruits[static_cast<std::size_t>(part.fruit)];
    EXPECT_TRUE(is_closed(part.mesh));
    EXPECT_NEAR(part.mesh.volume() * 1e6, truth.volume_cm3, 1e-3 * truth.volume_cm3);
    EXPECT_NEAR(part.mesh.area() * 1e4, truth.surface_cm2, 1e-3 * truth.surface_cm2);
    EXPECT_TRUE(part.mesh.bounds().contains(truth.centre));
    // The centroid lies near the middle of the body, whose ends differ a little.
    EXPECT_LT((part.mesh.bounds().center() - truth.centre).norm(), 0.012);
    const double longest = part.mesh.bounds().sizes().maxCoeff();
    EXPECT_GT(longest, 0.97 * std::min(truth.length_m, truth.diameter_m));
    EXPECT_LT(longest, 1.5 * std::max(truth.length_m, truth.diameter_m));
  }
  EXPECT_EQ(bodies, plant.fruits.size());
}

TEST(Plant, FruitsHangApartAndBesideTheirShoots) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed, "spacing");
    const Plant plant = grow_plant(plant_kind(seed % 2 == 0 ? 7 : 6), rng);
    for (std::size_t i = 0; i < plant.hanging.size(); ++i) {
      const HangingFruit& fruit = plant.hanging[i];
      const Vec3 p = fruit.T_plant_fruit.translation();
      EXPECT_GT(distance_to_shoots(plant.shoots, p), 0.4 * fruit.form.narrow_m);
      EXPECT_LT(distance_to_shoots(plant.shoots, p), 0.075);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE((p - plant.hanging[j].T_plant_fruit.translation()).norm(), 0.069) << seed;
        for (const auto& part : plant.parts) {
          if (part.fruit != static_cast<int>(j)) continue;
          for (const auto& v : part.mesh.vertices) {
            ASSERT_FALSE(touches_fruit(fruit, v.cast<double>(), 0.0)) << "seed " << seed;
          }
        }
      }
    }
  }
}

TEST(Plant, FruitSizesAndHeightsHaveTheMeasuredMeans) {
  // PLANTS: length 74 mm, diameter 68 mm, hull volume 171 cm³ (true 0.9 of it), height 0.43 m.
  double length = 0.0;
  double diameter = 0.0;
  double volume = 0.0;
  double height = 0.0;
  int towards_minus_x = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed, "sizes");
    for (const FruitTruth& f : grow_plant(plant_kind(5), rng).fruits) {
      length += f.length_m;
      diameter += f.diameter_m;
      volume += f.volume_cm3;
      height += f.centre.z();
      towards_minus_x += f.centre.x() < 0.0;
      ++count;
    }
  }
  EXPECT_NEAR(length / count, 0.074, 0.003);
  EXPECT_NEAR(diameter / count, 0.068, 0.003);
  EXPECT_NEAR(volume / count, 154.0, 15.0);
  // Of kind 5, the tallest; Population holds all kinds to it more closely.
  EXPECT_NEAR(height / count, 0.43, 0.043);
  EXPECT_GT(towards_minus_x, 0.6 * count);  // 26 of 34 on the −x side of the shoot
}

}  // namespace
}  // namespace canopeer
