#include "canopeer/sensing/lens_distortion.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "canopeer/sensing/rectification.h"

namespace canopeer {
namespace {

/// A wide lens of the kind that comes with RGB-D cameras.
constexpr LensDistortion kLens{-0.12, 0.03, 0.0008, -0.0006, -0.004};

TEST(LensDistortion, UndoesWhatItDid) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector2d ideal{rng.uniform(-0.9, 0.9), rng.uniform(-0.7, 0.7)};
    const Eigen::Vector2d back = kLens.undistort(kLens.distort(ideal));
    ASSERT_LT((back - ideal).norm(), 1e-10) << ideal.transpose();
  }
}

TEST(LensDistortion, FollowsTheFormulaOfOpenCV) {
  // Worked by hand for x = 0.5, y = −0.25: r² = 0.3125.
  const Eigen::Vector2d seen = kLens.distort({0.5, -0.25});
  const double radial =
      1.0 - 0.12 * 0.3125 + 0.03 * 0.3125 * 0.3125 - 0.004 * 0.3125 * 0.3125 * 0.3125;
  EXPECT_NEAR(seen.x(), 0.5 * radial + 2 * 0.0008 * -0.125 - 0.0006 * (0.3125 + 0.5), 1e-12);
  EXPECT_NEAR(seen.y(), -0.25 * radial + 0.0008 * (0.3125 + 0.125) + 2 * -0.0006 * -0.125, 1e-12);
}

TEST(Rectification, PutsEachPixelWhereThePinholeHasItToHalfAPixel) {
  const auto k = CameraIntrinsics::from_fov(320, 240, 1.4);
  // The raw image says in each pixel, times 100, the column a pinhole would have.
  Image<float> raw(k.width, k.height);
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      raw.at(u, v) = static_cast<float>(kLens.undistort(k.ray(u, v).head<2>()).x() * k.fx + k.cx);
    }
  }
  const Image<float> flat = Rectification(k, kLens).apply(raw, -1.0F);
  int filled = 0;
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      if (flat.at(u, v) < 0.0F) continue;
      ++filled;
      // Half a raw pixel each way is at most 0.8 pixels where the lens shrinks the image most.
      ASSERT_NEAR(flat.at(u, v), u + 0.5, 0.8);
    }
  }
  // A barrel lens sees more than the pinhole; this one is a little askew, so a few corners miss.
  EXPECT_GT(filled, 0.999 * k.width * k.height);
}

}  // namespace
}  // namespace canopeer
