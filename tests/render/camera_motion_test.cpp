#include "canopeer/render/camera_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "canopeer/base/rng.h"
#include "canopeer/render/motion/linear_light.h"
#include "canopeer/render/motion/shutter.h"

namespace canopeer {
namespace {

TEST(CameraMotion, IsOffByDefaultAndOnInEveryPresetOfACamera) {
  EXPECT_FALSE(CameraMotionOptions{}.any());
  for (const std::string& name : camera_motion_names()) {
    const CameraMotionOptions o = camera_motion_preset(name);
    EXPECT_EQ(o.any(), name != "none") << name;
    EXPECT_TRUE(o.validate()) << name;
  }
  // Only one of them has a rolling shutter, and only in colour.
  EXPECT_GT(camera_motion_preset("d435").readout_s, 0.0);
  EXPECT_FALSE(camera_motion_preset("d435").depth_rolls);
  EXPECT_EQ(camera_motion_preset("d405").readout_s, 0.0);
  EXPECT_EQ(camera_motion_preset("global_shutter").readout_s, 0.0);
}

TEST(CameraMotion, RefusesFiguresThatCannotBe) {
  const auto refused = [](auto change) {
    CameraMotionOptions o = camera_motion_preset("d435");
    change(o);
    return !o.validate();
  };
  EXPECT_TRUE(refused([](auto& o) { o.exposure_s = -0.001; }));
  EXPECT_TRUE(refused([](auto& o) { o.exposure_s = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& o) { o.readout_s = 2.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.latency_s = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.stamp_jitter_s = -0.001; }));
  EXPECT_TRUE(refused([](auto& o) { o.stamp_offset_s = -1.5; }));
  EXPECT_TRUE(refused([](auto& o) { o.sub_frames = 0; }));
  EXPECT_FALSE(refused([](auto& o) { o.stamp_offset_s = -0.03; }));
}

TEST(CameraMotion, StampsHaveTheGivenOffsetAndScatter) {
  CameraMotionOptions o;
  o.stamp_offset_s = 0.03;
  EXPECT_EQ(time_stamp(o, 7.0, 1, 5), 7.03);
  o.stamp_jitter_s = 0.002;
  constexpr int kFrames = 4000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    const double error = time_stamp(o, 7.0, 1, number) - 7.0;
    sum += error;
    squares += (error - 0.03) * (error - 0.03);
  }
  // Four standard errors of a mean and of a standard deviation.
  EXPECT_NEAR(sum / kFrames, 0.03, 4 * 0.002 / std::sqrt(kFrames));
  EXPECT_NEAR(std::sqrt(squares / kFrames), 0.002, 4 * 0.002 / std::sqrt(2.0 * kFrames));
  EXPECT_EQ(time_stamp(o, 7.0, 1, 3), time_stamp(o, 7.0, 1, 3));
  EXPECT_NE(time_stamp(o, 7.0, 1, 3), time_stamp(o, 7.0, 1, 4));
  EXPECT_NE(time_stamp(o, 7.0, 1, 3), time_stamp(o, 7.0, 2, 3));
}

TEST(Shutter, ARowSeesOfEachSubFrameTheTimeItSharesWithIt) {
  Rng rng(3, "shutter");
  for (int round = 0; round < 300; ++round) {
    CameraMotionOptions o;
    o.exposure_s = rng.uniform(0.0001, 0.02);
    o.readout_s = rng.chance(0.3) ? 0.0 : rng.uniform(0.0, 0.03);
    const int rows = 2 + static_cast<int>(rng.index(480));
    const int count = 1 + 2 * static_cast<int>(rng.index(8));
    const Shutter shutter(o, rows, count);
    const double slice = (o.exposure_s + o.readout_s) / count;
    EXPECT_EQ(shutter.time_s(count / 2), 0.0);
    for (int v = 0; v < rows; v += 7) {
      const RowExposure row = shutter.color_row(v);
      const double middle = (v / (rows - 1.0) - 0.5) * o.readout_s;
      ASSERT_GE(row.first, 0);
      ASSERT_LT(row.last(), count);
      ASSERT_EQ(std::accumulate(row.shares.begin(), row.shares.end(), 0U), RowExposure::kWhole);
      EXPECT_LE(std::abs(shutter.time_s(row.middle) - middle), slice / 2 * (1 + 1e-9));
      for (int i = 0; i < count; ++i) {
        const double begin = std::max(shutter.time_s(i) - slice / 2, middle - o.exposure_s / 2);
        const double end = std::min(shutter.time_s(i) + slice / 2, middle + o.exposure_s / 2);
        const double expected = std::max(0.0, end - begin) / o.exposure_s;
        const bool seen = i >= row.first && i <= row.last();
        const double share =
            seen ? row.shares[static_cast<std::size_t>(i - row.first)] / 65536.0 : 0.0;
        ASSERT_NEAR(share, expected, 2.0 / 65536) << "round " << round << ", row " << v;
      }
    }
  }
}

TEST(Shutter, WithoutExposureARowSeesOneSubFrame) {
  CameraMotionOptions o;
  o.readout_s = 0.01;
  const Shutter shutter(o, 480, 9);
  EXPECT_EQ(shutter.color_row(0).first, 0);
  EXPECT_EQ(shutter.color_row(479).first, 8);
  EXPECT_EQ(shutter.color_row(240).shares.size(), 1U);
  EXPECT_EQ(shutter.depth_row(479).first, 8);
  o.depth_rolls = false;
  EXPECT_EQ(Shutter(o, 480, 9).depth_row(479).first, 4);
}

TEST(Shutter, SubFramesLieWithinAPixelOfEachOtherAndAreNoMoreThanThat) {
  EXPECT_EQ(sub_frames_for(0.0, 15), 1);
  EXPECT_EQ(sub_frames_for(0.49, 15), 1);
  for (double px = 0.5; px < 15.0; px += 0.1) {
    const int count = sub_frames_for(px, 15);
    EXPECT_EQ(count % 2, 1);
    EXPECT_LE(px / count, 1.0);
    EXPECT_LE(count, std::max(3.0, px + 2.0));
  }
  EXPECT_EQ(sub_frames_for(1e9, 15), 15);
  EXPECT_EQ(sub_frames_for(1e9, 8), 7);
  EXPECT_EQ(sub_frames_for(1e9, 2), 1);
  EXPECT_EQ(sub_frames_for(std::numeric_limits<double>::infinity(), 5), 5);
}

TEST(LinearLight, EveryValueComesBackAndHalfTheLightOfWhiteIs188) {
  const LinearLight& light = linear_light();
  for (int i = 0; i < 256; ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    EXPECT_EQ(light.value(light.of(value)), value);
    if (i == 0) continue;
    EXPECT_GT(light.of(value), light.of(static_cast<std::uint8_t>(i - 1)));
  }
  EXPECT_EQ(light.of(0), 0);
  EXPECT_EQ(light.of(255), 65535);
  EXPECT_EQ(light.value(32768), 188);
}

}  // namespace
}  // namespace canopeer
