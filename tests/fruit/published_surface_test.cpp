#include "published_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../detect/synthetic_view.h"
#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

using namespace synthetic;

const Vec3 kCentre(0.6, 0.0, 0.6);

Mask fruit_of(const View& view) {
  Mask mask = view.fruit;
  for (auto& m : mask.pixels()) m = m != 0 ? 1 : 0;
  return mask;
}

TEST(NeighbourDistances, AreThoseToTheNearestOfAllPointsOnASmoothSurface) {
  Rng rng(1);
  constexpr int kSide = 24;
  Image<Vec3> points(kSide, kSide, Vec3::Zero());
  Mask there(kSide, kSide, 0);
  std::vector<int> pixels;
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      if (rng.uniform(0.0, 1.0) < 0.2) continue;  // holes
      const Vec3 jitter{rng.normal(0, 2e-4), rng.normal(0, 2e-4), rng.normal(0, 2e-4)};
      points.at(u, v) = Vec3(0.002 * u, 0.002 * v, 0.5 + 0.001 * u) + jitter;
      there.at(u, v) = 1;
      pixels.push_back(v * kSide + u);
    }
  }
  const std::vector<double> means = neighbour_distances(points, there, pixels, 5);
  ASSERT_EQ(means.size(), pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Vec3& p = points.pixels()[static_cast<std::size_t>(pixels[i])];
    std::vector<double> all;
    for (const int other : pixels) {
      if (other != pixels[i]) {
        all.push_back((points.pixels()[static_cast<std::size_t>(other)] - p).norm());
      }
    }
    std::sort(all.begin(), all.end());
    const double expected = (all[0] + all[1] + all[2] + all[3] + all[4]) / 5.0;
    EXPECT_NEAR(means[i], expected, 1e-12) << pixels[i];
  }
}

TEST(NeighbourDistances, OfALonePointAreInfinite) {
  Image<Vec3> points(12, 12, Vec3::Zero());
  Mask there(12, 12, 0);
  there.at(3, 3) = 1;
  EXPECT_TRUE(std::isinf(neighbour_distances(points, there, {3 * 12 + 3}, 5).front()));
}

TEST(OutlierLimit, IsTheMeanAndAShareOfTheStandardDeviation) {
  // Mean 3, sample variance 2.5.
  EXPECT_NEAR(outlier_limit({1, 2, 3, 4, 5}, 0.0), 3.0, 1e-12);
  EXPECT_NEAR(outlier_limit({1, 2, INFINITY, 3, 4, 5}, 2.0), 3.0 + 2.0 * std::sqrt(2.5), 1e-12);
  EXPECT_TRUE(std::isinf(outlier_limit({1.0}, 1.0)));
}

TEST(PublishedSurface, FindsABallsSeenSideWhenItHasPointsEnough) {
  const View view = look({ball(kCentre, 0.035, kRipe, true)}, {0.1, 0.0, 0.6}, kCentre);
  PublishedSurface all({.drop_outliers = false});
  all.add(view.frame, fruit_of(view));
  const std::vector<Vec3> centres = all.fruit_centres();
  ASSERT_EQ(centres.size(), 1U);
  // The mean of the seen half: before the centre, beside it nowhere.
  EXPECT_LT(centres[0].x(), kCentre.x());
  EXPECT_NEAR(centres[0].y(), kCentre.y(), 0.003);
  EXPECT_NEAR(centres[0].z(), kCentre.z(), 0.003);

  PublishedSurface strict({.drop_outliers = false, .min_points = 1000000});
  strict.add(view.frame, fruit_of(view));
  EXPECT_TRUE(strict.fruit_centres().empty());
}

TEST(PublishedSurface, LosesPointsToTheOutlierRemoval) {
  const View view = look({ball(kCentre, 0.035, kRipe, true)}, {0.1, 0.0, 0.6}, kCentre);
  // The rim is seen aslant, so its points lie farther apart: it goes, and with it the mean's depth.
  PublishedSurface all({.drop_outliers = false});
  PublishedSurface thinned({});
  all.add(view.frame, fruit_of(view));
  thinned.add(view.frame, fruit_of(view));
  ASSERT_EQ(all.fruit_centres().size(), 1U);
  ASSERT_EQ(thinned.fruit_centres().size(), 1U);
  EXPECT_LT(thinned.fruit_centres()[0].x(), all.fruit_centres()[0].x() - 0.001);
}

}  // namespace
}  // namespace canopeer
