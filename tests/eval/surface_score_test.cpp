#include "canopeer/eval/surface_score.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/base/rng.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

using Point = Eigen::Vector3f;

std::vector<Point> random_points(Rng& rng, int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        Vec3{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)}.cast<float>());
  }
  return points;
}

TEST(SurfaceScore, ShareNearIsThatOfComparingAllPairs) {
  Rng rng(5);
  for (int i = 0; i < 20; ++i) {
    const auto a = random_points(rng, 200);
    const auto b = random_points(rng, 100);
    int near = 0;
    for (const auto& p : a) {
      near +=
          std::any_of(b.begin(), b.end(), [&](const Point& q) { return (p - q).norm() <= 0.015F; })
              ? 1
              : 0;
    }
    EXPECT_DOUBLE_EQ(share_near(a, b, 0.015).value(), near / 200.0);
  }
  EXPECT_FALSE(share_near({}, random_points(rng, 3), 0.015).has_value());
}

TEST(SurfaceScore, TheTruthItselfScoresOneAndHalfOfItHalfTheRecall) {
  const Scene scene = make_world(scenario_1_world(), 1);
  auto points = fruit_surface_points(scene, true);
  const auto whole = surface_score(scene, points);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->precision, 1.0);
  EXPECT_EQ(whole->recall, 1.0);
  EXPECT_EQ(whole->f1, 1.0);
  std::erase_if(points, [](const Point& p) { return p.x() > 0.0F; });
  const auto half = surface_score(scene, points);
  EXPECT_EQ(half->precision, 1.0);
  EXPECT_GT(half->recall, 0.3);
  EXPECT_LT(half->recall, 0.7);
  EXPECT_NEAR(half->f1, 2.0 * half->recall / (1.0 + half->recall), 1e-12);
}

TEST(SurfaceScore, FruitByFruitIsTheSameAsAllAtOnceAndKnowsCopies) {
  WorldOptions row = row_100m_world();
  row.plants.resize(8);
  row.copies = 3;
  for (const Scene& scene : {make_world(row, 2), make_world(scenario_1_world(), 3)}) {
    // Some of the surface, off by up to 2 cm.
    Rng rng(4, "reconstruction");
    std::vector<Point> points;
    for (const Point& p : fruit_surface_points(scene, false)) {
      if (p.z() < 0.4F || !rng.chance(0.05)) continue;
      points.push_back(p + 0.2F * random_points(rng, 1).front());
    }
    ASSERT_FALSE(points.empty());
    const auto score = surface_score(scene, points);
    ASSERT_TRUE(score.has_value());
    EXPECT_EQ(score->precision,
              *share_near(points, fruit_surface_points(scene, false), kSurfaceMatchDistanceM));
    EXPECT_EQ(score->recall,
              *share_near(fruit_surface_points(scene, true), points, kSurfaceMatchDistanceM));
    EXPECT_LT(score->precision, 1.0);
    EXPECT_LT(score->recall, 1.0);
  }
}

TEST(SurfaceScore, PointsOffTheFruitsCostPrecisionOnly) {
  const Scene scene = make_world(scenario_1_world(), 1);
  auto points = fruit_surface_points(scene, true);
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(0.0F, 0.0F, 5.0F);
  const auto score = surface_score(scene, points);
  EXPECT_NEAR(score->precision, 0.5, 1e-9);
  EXPECT_EQ(score->recall, 1.0);
}

TEST(SurfaceScore, WithoutAReconstructionItIsZeroAndWithoutFruitsThereIsNone) {
  const auto none = surface_score(make_world(scenario_1_world(), 1), {});
  ASSERT_TRUE(none.has_value());
  EXPECT_EQ(none->f1, 0.0);
  EXPECT_FALSE(surface_score(Scene{}, {}).has_value());
}

}  // namespace
}  // namespace canopeer
