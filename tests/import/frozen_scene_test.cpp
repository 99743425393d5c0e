#include "canopeer/import/frozen_scene.h"

#include <gtest/gtest.h>

#include "canopeer/scene/ground_truth_csv.h"
#include "canopeer/scene/scene_hash.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

TEST(FrozenScene, ReadsBackAsItWasFrozenTruthAndAll) {
  WorldOptions options;
  options.name = "frozen";
  add_row({0.75, 0.0, 0.5, 2, 0.0, PlantPreset::numbered, {5, 7}}, &options);
  const Scene grown = make_world(options, 3);
  const auto frozen = frozen_scene(grown);
  ASSERT_TRUE(frozen.has_value());
  const auto again = parse_scene(*scene_bytes(*frozen));
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(scene_hash(*again), scene_hash(*frozen));
  EXPECT_EQ(ground_truth_csv(*again), ground_truth_csv(*frozen));
}

TEST(FrozenScene, TheTruthIsThatOfTheMeshesOnTheGrid) {
  WorldOptions options;
  options.name = "frozen";
  add_row({0.75, 0.0, 0.5, 2, 0.0, PlantPreset::numbered, {5, 7}}, &options);
  const Scene grown = make_world(options, 3);
  const auto frozen = frozen_scene(grown);
  ASSERT_TRUE(frozen.has_value());
  ASSERT_EQ(frozen->fruits.size(), grown.fruits.size());
  int bodies = 0;
  for (const ScenePart& part : frozen->parts) {
    if (part.fruit < 0) continue;
    ++bodies;
    const FruitTruth& fruit = frozen->fruits[static_cast<std::size_t>(part.fruit)];
    EXPECT_DOUBLE_EQ(fruit.volume_cm3, part.mesh.volume() * 1e6);
    const FruitTruth& before = grown.fruits[static_cast<std::size_t>(part.fruit)];
    EXPECT_NEAR(fruit.volume_cm3, before.volume_cm3, 0.005 * before.volume_cm3);
    EXPECT_LT((fruit.centre - before.centre).norm(), 1e-4);
    EXPECT_EQ(fruit.length_m, before.length_m);
  }
  EXPECT_EQ(bodies, static_cast<int>(grown.fruits.size()));
}

}  // namespace
}  // namespace canopeer
