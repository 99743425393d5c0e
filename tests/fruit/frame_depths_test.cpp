#include "canopeer/fruit/surface/frame_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr float kRange = 1.6F;
constexpr float kStep = 0.012F;

/// Surfaces with steps between, holes, and some of it too far away.
DepthImage patchwork(int width, int height, Rng& rng) {
  DepthImage depth(width, height, 0.0F);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double part = 0.4 + 0.7 * ((u / 5 + v / 7) % 3);
      const bool hole = rng.uniform(0.0, 1.0) < 0.05;
      depth.at(u, v) = hole ? 0.0F : static_cast<float>(part + rng.uniform(0.0, 0.015));
    }
  }
  return depth;
}

/// One pixel at a time, as the declaration says it.
float marked_one(const DepthImage& depth, int u, int v) {
  const float z = depth.at(u, v);
  bool edge = u == 0 || v == 0 || u + 1 == depth.width() || v + 1 == depth.height() || z > kRange;
  for (const auto& [du, dv] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    if (edge) break;
    const float near = depth.at(u + du, v + dv);
    edge = near > 0.0F && std::abs(near - z) > kStep;
  }
  return edge ? -z : z;
}

TEST(FrameDepths, MarkPixelsAtEdgesAndFarAway) {
  Rng rng(1);
  FrameDepths depths;
  for (const int width : {1, 2, 9, 10, 17, 40, 53}) {
    const DepthImage depth = patchwork(width, 1 + width / 2, rng);
    for (const SimdLevel level : {SimdLevel::scalar, best_simd_level()}) {
      depths.set(depth, kRange, kStep, level);
      for (int v = 0; v < depth.height(); ++v) {
        const float* const row = depths.marked() + (v + 1) * depths.stride() + 1;
        for (int u = 0; u < width; ++u) {
          ASSERT_EQ(row[u], marked_one(depth, u, v)) << width << ": " << u << " " << v;
        }
        ASSERT_EQ(row[-1], 0.0F);
        ASSERT_EQ(row[width], 0.0F);
      }
      for (int u = -1; u <= width; ++u) {
        ASSERT_EQ(depths.marked()[u + 1], 0.0F);
        ASSERT_EQ(depths.marked()[(depth.height() + 1) * depths.stride() + u + 1], 0.0F);
      }
    }
  }
}

TEST(FrameDepths, KnowTheFarthestDepthOfARectangle) {
  DepthImage depth(50, 30, 0.5F);
  depth.at(49, 29) = 2.0F;
  depth.at(20, 10) = 1.5F;
  FrameDepths depths;
  depths.set(depth, kRange, kStep);
  EXPECT_EQ(depths.farthest(-10.0, -10.0, 100.0, 100.0), 2.0F);
  EXPECT_EQ(depths.farthest(20.0, 10.0, 20.5, 10.5), 1.5F);
  EXPECT_EQ(depths.farthest(0.0, 0.0, 3.0, 3.0), 0.5F);
  EXPECT_EQ(depths.farthest(60.0, 0.0, 70.0, 10.0), 0.0F);
}

TEST(FrameDepths, AreNeverNearerThanAPixelOfTheRectangle) {
  Rng rng(2);
  FrameDepths depths;
  const DepthImage depth = patchwork(61, 43, rng);
  depths.set(depth, kRange, kStep);
  for (int trial = 0; trial < 300; ++trial) {
    const double u = rng.uniform(-5.0, 60.0);
    const double v = rng.uniform(-5.0, 42.0);
    const double to_u = u + rng.uniform(0.0, 20.0);
    const double to_v = v + rng.uniform(0.0, 20.0);
    float most = 0.0F;
    for (int y = std::max(0, int(std::ceil(v))); y <= std::min(42, int(std::floor(to_v))); ++y) {
      for (int x = std::max(0, int(std::ceil(u))); x <= std::min(60, int(std::floor(to_u))); ++x) {
        most = std::max(most, depth.at(x, y));
      }
    }
    EXPECT_GE(depths.farthest(u, v, to_u, to_v), most);
  }
}

}  // namespace
}  // namespace canopeer
