#include "canopeer/scene/row_world.h"

#include <gtest/gtest.h>

#include <bit>

#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

std::uint64_t hash_of(const Scene& scene) {  // FNV-1a over all coordinates and colours
  std::uint64_t h = 0xcbf29ce484222325ULL;
  const auto add = [&h](std::uint64_t x) { h = (h ^ x) * 0x100000001b3ULL; };
  for (const ScenePart& part : scene.parts) {
    for (const auto& v : part.mesh.vertices) {
      for (int i = 0; i < 3; ++i) add(std::bit_cast<std::uint32_t>(v[i]));
    }
    add(part.color.r * 65536U + part.color.g * 256U + part.color.b);
    add(static_cast<std::uint64_t>(part.kind));
  }
  for (const FruitTruth& f : scene.fruits) add(std::bit_cast<std::uint64_t>(f.centre.x()));
  return h;
}

TEST(RowWorld, Scenario1HasFortySevenCountedFruitsForEverySeed) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Scene scene = make_world(scenario_1_world(), seed);
    EXPECT_EQ(scene.counted_fruits(), 47) << "seed " << seed;
    EXPECT_EQ(scene.fruits.size(), 54U);
    for (std::size_t i = 0; i < scene.fruits.size(); ++i) {
      EXPECT_EQ(scene.fruits[i].id, static_cast<int>(i));
      EXPECT_EQ(scene.fruits[i].counted, scene.fruits[i].ripeness != Ripeness::green);
    }
  }
}

TEST(RowWorld, SameSeedGivesTheSameSceneAndAnotherSeedAnother) {
  const auto first = hash_of(make_world(scenario_1_world(), 5));
  EXPECT_EQ(first, hash_of(make_world(scenario_1_world(), 5)));
  EXPECT_NE(first, hash_of(make_world(scenario_1_world(), 6)));
}

TEST(RowWorld, GroundTruthAgreesWithTheBodiesInTheWorld) {
  const Scene scene = make_world(scenario_1_world(), 2);
  int bodies = 0;
  for (const ScenePart& part : scene.parts) {
    ASSERT_EQ(part.mesh.normals.size(), part.mesh.vertices.size());
    if (part.kind != PartClass::fruit) continue;
    ++bodies;
    const FruitTruth& truth = scene.fruits[static_cast<std::size_t>(part.fruit)];
    EXPECT_EQ(truth.plant, part.plant);
    EXPECT_LT((part.mesh.bounds().center() - truth.centre).norm(), 0.012);
    EXPECT_NEAR(part.mesh.volume() * 1e6, truth.volume_cm3, 1e-2 * truth.volume_cm3);
    const Vec3 place = scenario_1_world().plants[static_cast<std::size_t>(part.plant)].position;
    EXPECT_LT((truth.centre - place).head<2>().norm(), 0.4);
  }
  EXPECT_EQ(bodies, 54);
}

TEST(RowWorld, NoFruitIsTouchedByAnotherPlant) {
  const Scene scene = make_world(scenario_1_world(), 3);
  for (const ScenePart& part : scene.parts) {
    if (part.plant < 0) continue;
    for (const FruitTruth& fruit : scene.fruits) {
      if (fruit.plant == part.plant) continue;
      for (const auto& v : part.mesh.vertices) {
        // Half the smaller extent is inside the body for sure.
        ASSERT_GT((v.cast<double>() - fruit.centre).norm(), 0.4 * fruit.diameter_m);
      }
    }
  }
}

TEST(RowWorld, HoldsFloorWallsAndReddishThingsThatAreNoFruit) {
  const Scene scene = make_world(scenario_1_world(), 1);
  int distractors = 0;
  for (const ScenePart& part : scene.parts) distractors += part.kind == PartClass::distractor;
  EXPECT_GE(distractors, 15);
  const Box room = scene.bounds();
  EXPECT_NEAR(room.max().x(), 3.9, 1e-3);
  EXPECT_GT(scene.bounds(true).min().z(), -0.004);  // the rim of a leaning stem
  EXPECT_LT(scene.bounds(true).max().z(), 1.4);

  WorldOptions bare = scenario_1_world();
  bare.walls = bare.floor = bare.pipes = false;
  bare.distractors = 0;
  for (const ScenePart& part : make_world(bare, 1).parts) EXPECT_GE(part.plant, 0);
}

}  // namespace
}  // namespace canopeer
