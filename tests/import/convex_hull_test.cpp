#include "canopeer/import/assembly/convex_hull.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

std::vector<Vec3> corners(const Box& box) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(box.corner(static_cast<Box::CornerType>(i)));
  return points;
}

TEST(ConvexHull, OfABoxIsTheBox) {
  auto points = corners(Box(Vec3(1, 2, 3), Vec3(1.1, 2.2, 3.4)));
  points.emplace_back(1.05, 2.1, 3.2);  // inside: changes nothing
  const auto hull = convex_hull(points);
  ASSERT_TRUE(hull.has_value());
  EXPECT_NEAR(hull->volume_m3, 0.1 * 0.2 * 0.4, 1e-12);
  EXPECT_NEAR(hull->area_m2, 2.0 * (0.1 * 0.2 + 0.1 * 0.4 + 0.2 * 0.4), 1e-12);
  EXPECT_LT((hull->centroid - Vec3(1.05, 2.1, 3.2)).norm(), 1e-12);
  EXPECT_EQ(hull->vertices.size(), 8U);
  // Second moments of a box about its centre: side² / 12.
  EXPECT_NEAR(hull->covariance(0, 0), 0.01 / 12.0, 1e-12);
  EXPECT_NEAR(hull->covariance(2, 2), 0.16 / 12.0, 1e-12);
  EXPECT_NEAR(hull->covariance(0, 1), 0.0, 1e-12);
  EXPECT_TRUE(hull->contains(Vec3(1.05, 2.1, 3.39)));
  EXPECT_FALSE(hull->contains(Vec3(1.05, 2.1, 3.41)));
  EXPECT_TRUE(hull->contains(Vec3(1.05, 2.1, 3.41), 0.02));
}

TEST(ConvexHull, HoldsAllItsPoints) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed, "hull");
    std::vector<Vec3> points;
    for (int i = 0; i < 200; ++i) {
      points.push_back({rng.normal(0.0, 0.03), rng.normal(0.0, 0.05), rng.normal(2.0, 0.02)});
    }
    const auto hull = convex_hull(points);
    ASSERT_TRUE(hull.has_value());
    for (const Vec3& p : points) ASSERT_TRUE(hull->contains(p, 1e-12)) << "seed " << seed;
    EXPECT_TRUE(hull->contains(hull->centroid));
  }
}

TEST(ConvexHull, OfFlatOrFewPointsIsNone) {
  EXPECT_FALSE(convex_hull({}).has_value());
  auto points = corners(Box(Vec3(0, 0, 0), Vec3(1, 1, 0)));
  EXPECT_FALSE(convex_hull(points).has_value());
  points.assign(10, Vec3(1, 2, 3));
  EXPECT_FALSE(convex_hull(points).has_value());
}

}  // namespace
}  // namespace canopeer
