#include "canopeer/render/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace canopeer {
namespace {

const CameraIntrinsics kCamera = CameraIntrinsics::from_fov(320, 240, 1.3);

DepthImage wall_at(float z) { return {kCamera.width, kCamera.height, z}; }

/// Mean and standard deviation of the returns, and their number.
struct Returns {
  double mean = 0.0;
  double sd = 0.0;
  int count = 0;
};

Returns returns_of(const DepthImage& depth) {
  Returns r;
  double sum = 0.0;
  double squares = 0.0;
  for (const float z : depth.pixels()) {
    if (z <= 0.0F) continue;
    ++r.count;
    sum += z;
    squares += static_cast<double>(z) * z;
  }
  r.mean = sum / r.count;
  r.sd = std::sqrt(std::max(0.0, squares / r.count - r.mean * r.mean));
  return r;
}

TEST(SensorNoise, NothingIsChangedWhenAllIsOff) {
  const DepthImage wall = wall_at(0.777F);
  EXPECT_FALSE(SensorNoiseOptions{}.any_depth());
  EXPECT_TRUE(noisy_depth(wall, kCamera, {}, 1).pixels() == wall.pixels());
  const ColorImage grey(32, 24, {90, 120, 30});
  EXPECT_TRUE(noisy_color(grey, {}, 1).pixels() == grey.pixels());
}

TEST(SensorNoise, AxialNoiseGrowsWithTheSquareOfTheRange) {
  SensorNoiseOptions o;
  o.baseline_m = 0.05;
  o.disparity_noise_px = 0.08;
  for (const double cell : {1.0, 3.0}) {
    o.correlation_px = cell;
    for (const float z : {0.4F, 0.8F, 1.6F}) {
      const Returns r = returns_of(noisy_depth(wall_at(z), kCamera, o, 7));
      const double expected = z * z * 0.08 / (kCamera.fx * 0.05);
      // 76 800 values, of which one in nine is independent at most: its own error is below 2 %.
      EXPECT_NEAR(r.sd, expected, 0.05 * expected) << z << " m, cell " << cell;
      EXPECT_NEAR(r.mean, z, 0.03 * expected + 0.1 * expected * expected / z);
    }
  }
}

TEST(SensorNoise, NeighboursErrAlikeWhenMatchingWindowsOverlap) {
  SensorNoiseOptions o;
  o.baseline_m = 0.05;
  o.disparity_noise_px = 0.08;
  const auto correlation = [&](double cell) {
    o.correlation_px = cell;
    const DepthImage d = noisy_depth(wall_at(1.0F), kCamera, o, 3);
    double sum = 0.0;
    double squares = 0.0;
    for (int v = 0; v < d.height(); ++v) {
      for (int u = 0; u + 1 < d.width(); ++u) {
        sum += (d.at(u, v) - 1.0) * (d.at(u + 1, v) - 1.0);
        squares += (d.at(u, v) - 1.0) * (d.at(u, v) - 1.0);
      }
    }
    return sum / squares;
  };
  EXPECT_LT(std::abs(correlation(1.0)), 0.03);
  EXPECT_GT(correlation(3.0), 0.5);
}

TEST(SensorNoise, DisparitiesComeInSteps) {
  SensorNoiseOptions o;
  o.baseline_m = 0.05;
  o.disparity_step_px = 0.125;
  DepthImage slope(kCamera.width, kCamera.height);
  for (int v = 0; v < slope.height(); ++v) {
    for (int u = 0; u < slope.width(); ++u) slope.at(u, v) = 0.5F + 0.001F * static_cast<float>(u);
  }
  const DepthImage d = noisy_depth(slope, kCamera, o, 1);
  for (std::size_t i = 0; i < d.pixels().size(); ++i) {
    const double steps = kCamera.fx * 0.05 / d.pixels()[i] / 0.125;
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
    const double z = slope.pixels()[i];
    ASSERT_NEAR(d.pixels()[i], z, 0.51 * 0.125 * z * z / (kCamera.fx * 0.05) * 1.02);
  }
}

/// Something near, columns 120 … 199, in front of a wall.
DepthImage box_before_wall(float near, float far) {
  DepthImage depth = wall_at(far);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 120; u < 200; ++u) depth.at(u, v) = near;
  }
  return depth;
}

TEST(SensorNoise, TheSecondImagersShadowFallsLeftOfWhatIsNear) {
  SensorNoiseOptions o;
  o.baseline_m = 0.05;
  o.baseline_shadow = true;
  const DepthImage d = noisy_depth(box_before_wall(0.5F, 1.0F), kCamera, o, 1);
  // As wide as the difference of the disparities.
  const double width = kCamera.fx * 0.05 * (1.0 / 0.5 - 1.0 / 1.0);
  int lost = 0;
  for (int u = 0; u < d.width(); ++u) {
    if (d.at(u, 100) > 0.0F) continue;
    ++lost;
    EXPECT_LT(u, 120);
    EXPECT_GE(u, 120 - width - 1.0);
  }
  EXPECT_NEAR(lost, width, 1.0);
}

TEST(SensorNoise, EdgesLosePixelsAndGrowFlyingOnes) {
  SensorNoiseOptions o;
  o.lost_at_edge = 0.3;
  o.flying_at_edge = 0.5;
  const DepthImage d = noisy_depth(box_before_wall(0.5F, 1.0F), kCamera, o, 5);
  int lost = 0;
  int flying = 0;
  int edge = 0;
  for (int v = 0; v < d.height(); ++v) {
    for (int u = 0; u < d.width(); ++u) {
      const float z = d.at(u, v);
      const bool at_edge = (u >= 119 && u <= 120) || (u >= 199 && u <= 200);
      edge += at_edge;
      lost += z == 0.0F;
      flying += z > 0.0F && z != 0.5F && z != 1.0F;
      if (!at_edge) {
        ASSERT_TRUE(z == 0.5F || z == 1.0F) << u;
      }
    }
  }
  EXPECT_NEAR(lost, 0.3 * edge, 0.06 * edge);
  EXPECT_NEAR(flying, 0.35 * edge, 0.06 * edge);
}

TEST(SensorNoise, GrazingSurfacesAreLost) {
  SensorNoiseOptions o;
  o.lost_below_cosine = 0.1;
  o.kept_above_cosine = 0.34;
  // A plane through (0, 0, 1) that turns about the image's vertical: share of returns in the
  // middle, where the ray is the axis.
  const auto share = [&](double degrees) {
    const double t = std::tan(degrees * std::numbers::pi / 180.0);
    DepthImage plane(kCamera.width, kCamera.height, 0.0F);
    for (int v = 0; v < plane.height(); ++v) {
      for (int u = 0; u < plane.width(); ++u) {
        const double z = 1.0 / (1.0 - t * kCamera.ray(u, v).x());
        plane.at(u, v) = z > 0.0 && z < 50.0 ? static_cast<float>(z) : 0.0F;
      }
    }
    const DepthImage d = noisy_depth(plane, kCamera, o, 9);
    int kept = 0;
    for (int v = 0; v < d.height(); ++v) {
      for (int u = 158; u < 162; ++u) kept += d.at(u, v) > 0.0F;
    }
    return kept / (4.0 * d.height());
  };
  EXPECT_EQ(share(0.0), 1.0);
  EXPECT_EQ(share(60.0), 1.0);
  EXPECT_NEAR(share(77.3), 0.5, 0.1);  // cos = 0.22
  EXPECT_LT(share(86.0), 0.02);
}

TEST(SensorNoise, EdgesWaverByTheLateralNoise) {
  SensorNoiseOptions o;
  o.lateral_px = 0.8;
  const DepthImage d = noisy_depth(box_before_wall(0.5F, 1.0F), kCamera, o, 2);
  int changed = 0;
  for (int v = 0; v < d.height(); ++v) {
    for (int u = 0; u < d.width(); ++u) {
      const float z = d.at(u, v);
      ASSERT_TRUE(z == 0.5F || z == 1.0F);
      const bool inside = u >= 120 && u < 200;
      changed += inside != (z == 0.5F);
    }
  }
  // On either side of an edge: P(shift ≥ ½) + P(≥ 1½) + … = 0.266 + 0.030 + 0.001 of a pixel.
  EXPECT_NEAR(changed / (4.0 * d.height()), 0.30, 0.06);
}

TEST(SensorNoise, ColourNoiseIsPoissonianAndGaussianAndFramesDifferInExposure) {
  SensorNoiseOptions o;
  o.color_read = 2.0;
  o.color_shot = 0.1;
  const auto spread = [&](std::uint8_t value) {
    const ColorImage image(200, 100, {value, value, value});
    double sum = 0.0;
    double squares = 0.0;
    const ColorImage noisy = noisy_color(image, o, 3);
    for (const Rgb& c : noisy.pixels()) {
      sum += c.g;
      squares += c.g * c.g;
    }
    return squares / 20000.0 - sum * sum / 4e8;
  };
  // Rounding to whole grey levels adds 1/12.
  EXPECT_NEAR(spread(40), 4.0 + 4.0 + 1.0 / 12, 0.4);
  EXPECT_NEAR(spread(160), 4.0 + 16.0 + 1.0 / 12, 1.0);
  SensorNoiseOptions exposure;
  exposure.exposure_spread = 0.1;
  const ColorImage image(2, 2, {100, 100, 100});
  EXPECT_NE(noisy_color(image, exposure, 1).at(0, 0).r, noisy_color(image, exposure, 2).at(0, 0).r);
}

TEST(SensorNoise, PresetsAreValidAndRepeat) {
  for (const std::string& name : sensor_noise_names()) {
    const SensorNoiseOptions o = sensor_noise_preset(name);
    EXPECT_TRUE(o.validate().has_value()) << name;
    const DepthImage scene = box_before_wall(0.4F, 0.9F);
    const DepthImage once = noisy_depth(scene, kCamera, o, 11);
    EXPECT_TRUE(once.pixels() == noisy_depth(scene, kCamera, o, 11).pixels());
    EXPECT_EQ(once.pixels() == noisy_depth(scene, kCamera, o, 12).pixels(), name == "none");
  }
  SensorNoiseOptions wrong;
  wrong.disparity_noise_px = 0.1;
  EXPECT_FALSE(wrong.validate().has_value());
}

}  // namespace
}  // namespace canopeer
