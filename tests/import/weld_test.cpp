#include "canopeer/import/assembly/weld.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

TEST(Weld, JoinsWhatTouchesAndNothingElse) {
  const std::vector<Eigen::Vector3f> points = {{0, 0, 0},     {1, 0, 0}, {0, 0, 4e-5F},
                                               {1, 0, 3e-4F}, {0, 0, 0}, {0, 0, 8e-5F}};
  EXPECT_EQ(weld(points, 5e-5), (std::vector<std::uint32_t>{0, 1, 0, 3, 0, 0}));
}

TEST(Weld, AgreesWithComparingAllPairs) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed, "weld");
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 300; ++i) {
      points.emplace_back(static_cast<float>(rng.uniform(-0.01, 0.01)),
                          static_cast<float>(rng.uniform(-0.01, 0.01)),
                          static_cast<float>(rng.uniform(-0.01, 0.01)));
    }
    constexpr double kTolerance = 0.0015;
    DisjointSets sets(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        if ((points[i].cast<double>() - points[j].cast<double>()).norm() <= kTolerance) {
          sets.join(i, j);
        }
      }
    }
    const auto welded = weld(points, kTolerance);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(welded[i], sets.find(i)) << "seed " << seed << ", point " << i;
    }
  }
}

}  // namespace
}  // namespace canopeer
