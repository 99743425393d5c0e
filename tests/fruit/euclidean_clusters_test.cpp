#include "canopeer/fruit/instances/euclidean_clusters.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

TEST(EuclideanClusters, AgreeWithComparingAllPairs) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 200; ++i) {
      points.push_back(
          {0.1 * Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}, Vec3::UnitZ()});
    }
    const double tolerance = rng.uniform(0.01, 0.04);
    std::vector<int> label(points.size());
    for (std::size_t i = 0; i < label.size(); ++i) label[i] = static_cast<int>(i);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < points.size(); ++j) {
          if ((points[i].point - points[j].point).norm() > tolerance || label[j] >= label[i]) {
            continue;
          }
          label[i] = label[j];
          changed = true;
        }
      }
    }
    const std::vector<int> cluster = euclidean_clusters(points, tolerance);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        ASSERT_EQ(cluster[i] == cluster[j], label[i] == label[j]) << "seed " << seed;
      }
    }
  }
}

TEST(EuclideanClusters, AreNumberedInTheOrderOfTheirFirstPoints) {
  const std::vector<SurfacePoint> points = {
      {{0, 0, 0}, {}}, {{1, 0, 0}, {}}, {{0.005, 0, 0}, {}}, {{2, 0, 0}, {}}};
  EXPECT_EQ(euclidean_clusters(points, 0.01), (std::vector<int>{0, 1, 0, 2}));
  EXPECT_TRUE(euclidean_clusters({}, 0.01).empty());
}

}  // namespace
}  // namespace canopeer
