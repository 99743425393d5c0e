#include "canopeer/scene/worlds.h"

#include <gtest/gtest.h>

#include "canopeer/scene/scene_hash.h"

namespace canopeer {
namespace {

/// Largest overlap of a fruit with what belongs to another plant: vertices inside its inner half.
int vertices_in_fruits_of_others(const Scene& scene) {
  int inside = 0;
  for (const FruitTruth& fruit : scene.fruits) {
    const Vec3 reach = Vec3::Constant(0.4 * fruit.diameter_m);
    const Box core(fruit.centre - reach, fruit.centre + reach);
    scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance* copy) {
      const int plant = copy == nullptr ? part.plant : copy->plant;
      if (plant < 0 || plant == fruit.plant) return;
      if (!core.intersects(transformed(part.mesh.bounds(), T))) return;
      for (const auto& v : part.mesh.vertices) {
        inside += (T * v.cast<double>() - fruit.centre).norm() < 0.4 * fruit.diameter_m;
      }
    });
  }
  return inside;
}

TEST(Worlds, Scenario2HasTwentyFourPlantsOnTwoLevelsAndNinetyFourCountedFruits) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Scene scene = make_world(scenario_2_world(), seed);
    EXPECT_EQ(scene.counted_fruits(), 94);
    EXPECT_EQ(scene.fruits.size(), 108U);
    EXPECT_EQ(scene.plant_count(), 24);
    int upper = 0;
    for (const FruitTruth& fruit : scene.fruits) upper += fruit.counted && fruit.centre.z() > 1.25;
    EXPECT_EQ(upper, 47);
  }
}

TEST(Worlds, TheUpperLevelStandsOnBoards) {
  const Scene scene = make_world(scenario_2_world(), 1);
  int boards = 0;
  for (const ScenePart& part : scene.parts) {
    if (!part.static_structure()) continue;
    const Box box = part.mesh.bounds();
    boards += std::abs(box.max().z() - 1.25) < 1e-6 && std::abs(box.sizes().y() - 3.0) < 1e-6;
    // Nothing else stands in the aisle or reaches from the floor to the boards.
    EXPECT_FALSE(box.min().z() < 0.01 && box.max().z() > 1.2 && std::abs(box.center().x()) < 1.0);
  }
  EXPECT_EQ(boards, 2);
}

TEST(Worlds, DenseCropsHaveTheirLeafAreaIndexAndHeight) {
  for (const auto& [world, lai] : {std::pair{dense_1_world(), 4.0}, {dense_2_world(), 5.0}}) {
    const Scene scene = make_world(world, 2);
    EXPECT_NEAR(scene.leaf_area() / scene.ground_m2, lai, 0.1 * lai) << world.name;
    std::vector<double> top(static_cast<std::size_t>(scene.plant_count()), 0.0);
    for (const ScenePart& part : scene.parts) {
      if (part.kind != PartClass::leaf) continue;
      double& z = top[static_cast<std::size_t>(part.plant)];
      z = std::max(z, part.mesh.bounds().max().z());
    }
    for (const double z : top) {
      EXPECT_GT(z, 2.0);
      EXPECT_LT(z, 3.4);
    }
    EXPECT_EQ(vertices_in_fruits_of_others(scene), 0) << world.name;
  }
}

TEST(Worlds, ALongRowIsMadeOfCopiesThatStandClearOfOneAnother) {
  const Scene scene = make_world(row_100m_world(), 1);
  EXPECT_EQ(scene.plant_count(), 400);
  EXPECT_LE(scene.models.size(), 21U);
  EXPECT_GT(scene.fruits.size(), 1000U);
  EXPECT_NEAR(scene.bounds(true).max().y(), 98.25, 0.6);
  for (std::size_t i = 0; i < scene.fruits.size(); ++i) {
    EXPECT_EQ(scene.fruits[i].id, static_cast<int>(i));
  }
  // Every copy's fruits are where the ground truth says.
  for (const SceneInstance& copy : scene.instances) {
    for (const ScenePart& part : scene.models[copy.model].parts) {
      if (part.fruit < 0) continue;
      const auto& truth = scene.fruits[static_cast<std::size_t>(copy.first_fruit + part.fruit)];
      EXPECT_EQ(truth.plant, copy.plant);
      EXPECT_LT((copy.T_world_model * part.mesh.bounds().center() - truth.centre).norm(), 0.015);
    }
  }
}

TEST(Worlds, TheSameSeedGivesTheSameWorldAndAnotherSeedAnother) {
  for (const char* name : {"scenario_1", "scenario_2", "dense_1", "seedlings", "row_100m"}) {
    const WorldOptions world = *named_world(name);
    const std::uint64_t first = scene_hash(make_world(world, 5));
    EXPECT_EQ(first, scene_hash(make_world(world, 5))) << name;
    EXPECT_NE(first, scene_hash(make_world(world, 6))) << name;
  }
}

TEST(Worlds, SeedlingsCarryNoFruitAndStayLow) {
  const Scene scene = make_world(seedlings_world(), 3);
  EXPECT_TRUE(scene.fruits.empty());
  EXPECT_EQ(scene.plant_count(), 20);
  EXPECT_LT(scene.bounds(true).max().z(), 0.75);
}

}  // namespace
}  // namespace canopeer
