#include "canopeer/render/occlusion.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include "canopeer/scene/plants/fruit_body.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

/// A fruit that hangs free at (0.7, 0, 0.8), and perhaps a board before it.
Scene one_fruit(bool board) {
  Scene scene;
  ScenePart fruit;
  fruit.mesh.append(make_fruit_body({}), Pose(Eigen::Translation3d(0.7, 0.0, 0.8)));
  fruit.kind = PartClass::fruit;
  fruit.fruit = 0;
  scene.parts.push_back(fruit);
  FruitTruth truth;
  truth.centre = Vec3(0.7, 0.0, 0.8);
  scene.fruits.push_back(truth);
  if (board) {
    ScenePart wall;
    wall.mesh = make_box(Box(Vec3(0.60, -1.0, 0.0), Vec3(0.62, 1.0, 0.8)));
    scene.parts.push_back(wall);
  }
  return scene;
}

TEST(Occlusion, AFreeFruitIsSeenButForItsOwnGrooves) {
  const Scene scene = one_fruit(false);
  const OcclusionProbe probe(scene);
  const FruitVisibility seen =
      visibility(probe, scene.fruits[0], ring_positions(scene.fruits[0].centre, {}));
  EXPECT_GT(seen.views, 30);
  // The grooves between its lobes hide about an eighth.
  EXPECT_GT(seen.median, 0.8);
  EXPECT_GT(seen.frontal, 0.8);
  EXPECT_EQ(seen.share_above_30, 1.0);
  // The ring allows positions on the aisle's side only; the back stays unseen.
  EXPECT_GT(seen.union_surface, 0.6);
  EXPECT_LT(seen.union_surface, 0.95);
}

TEST(Occlusion, WhatStandsBeforeAFruitHidesIt) {
  const Scene scene = one_fruit(true);
  const OcclusionProbe probe(scene);
  // The board reaches up to the fruit's middle: from far in front the upper half stays.
  EXPECT_NEAR(probe.view(0, Vec3(-20.0, 0.0, 0.8)).facing_share, 0.5, 0.1);
  EXPECT_EQ(probe.view(0, Vec3(0.0, 0.0, 0.3)).points.size(), 0U);
  EXPECT_GT(probe.view(0, Vec3(0.4, 0.0, 1.4)).facing_share, 0.6);
  // From behind it is free.
  EXPECT_GT(probe.view(0, Vec3(1.4, 0.0, 0.8)).facing_share, 0.8);
}

TEST(Occlusion, RingPositionsKeepToTheAisle) {
  const auto eyes = ring_positions(Vec3(0.7, 0.2, 0.4), {});
  EXPECT_GT(eyes.size(), 20U);
  for (const Vec3& eye : eyes) {
    EXPECT_LE(std::abs(eye.x()), 0.45);
    EXPECT_GE(eye.z(), 0.1);
    EXPECT_LE(eye.z(), 1.6);
    const double d = (eye - Vec3(0.7, 0.2, 0.4)).norm();
    EXPECT_TRUE(std::abs(d - 0.3) < 1e-9 || std::abs(d - 0.5) < 1e-9 || std::abs(d - 0.7) < 1e-9);
  }
}

// Measured on the paper's plants, medians over the fruits: best view 0.94, median view 0.73,
// straight in front 0.73, share of positions that show 30 % 0.90, whole surface together 0.80.
TEST(Occlusion, ThePapersPlantsHideTheirFruitsAsMeasured) {
  std::vector<double> best, median, frontal, share, whole;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = make_world(scenario_1_world(), seed);
    const OcclusionProbe probe(scene);
    for (const FruitVisibility& f : visibilities(scene, probe, 47, [](const FruitTruth& fruit) {
           return ring_positions(fruit.centre, {});
         })) {
      best.push_back(f.best);
      median.push_back(f.median);
      frontal.push_back(f.frontal);
      share.push_back(f.share_above_30);
      whole.push_back(f.union_surface);
    }
  }
  const auto middle = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  EXPECT_NEAR(middle(best), 0.94, 0.08);
  EXPECT_NEAR(middle(median), 0.73, 0.08);
  EXPECT_NEAR(middle(frontal), 0.73, 0.08);
  EXPECT_NEAR(middle(share), 0.90, 0.08);
  EXPECT_NEAR(middle(whole), 0.80, 0.08);
}

TEST(Occlusion, IsTheSameWithOneThreadAndWithTwo) {
  const Scene scene = make_world(scenario_1_world(), 2);
  const OcclusionProbe probe(scene);
  const auto look = [&] {
    return visibilities(scene, probe, 6,
                        [](const FruitTruth& fruit) { return ring_positions(fruit.centre, {}); });
  };
  std::vector<FruitVisibility> one;
  std::vector<FruitVisibility> two;
  oneapi::tbb::task_arena(1).execute([&] { one = look(); });
  oneapi::tbb::task_arena(2).execute([&] { two = look(); });
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].median, two[i].median);
    EXPECT_EQ(one[i].union_surface, two[i].union_surface);
  }
}

// A quarter of the fruits of a dense crop are shown to 30 % by no level view in front; other views
// show four in five of these.
TEST(Occlusion, DenseCropsHideFruitsThatOtherViewsFind) {
  int fruits = 0;
  int hidden = 0;
  int reachable = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Scene scene = make_world(dense_1_world(), seed);
    const OcclusionProbe probe(scene);
    RingOptions ring;
    ring.top_m = scene.bounds(true).max().z();
    for (const FruitVisibility& f : visibilities(scene, probe, 300, [&](const FruitTruth& fruit) {
           return ring_positions(fruit.centre, ring);
         })) {
      ++fruits;
      hidden += f.best_frontal_level < 0.3;
      reachable += f.best_frontal_level < 0.3 && f.best >= 0.3;
    }
  }
  EXPECT_NEAR(hidden / static_cast<double>(fruits), 0.25, 0.05);
  EXPECT_GE(reachable, 0.8 * hidden);
}

}  // namespace
}  // namespace canopeer
