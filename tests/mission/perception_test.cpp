#include "canopeer/mission/perception.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

TEST(Perception, DetectorsAreScoredAgainstTheRightLabelsNotTheNoisyOnes) {
  constexpr int kWidth = 40;
  constexpr int kHeight = 30;
  RgbdFrame frame;
  frame.intrinsics = CameraIntrinsics::from_fov(kWidth, kHeight, 1.0);
  frame.depth = DepthImage(kWidth, kHeight, 0.5F);
  frame.color = ColorImage(kWidth, kHeight);
  frame.labels = Image<PixelLabel>(kWidth, kHeight, PixelLabel::background);
  frame.true_labels = frame.labels;
  // Four rows of fruit; the camera's labels miss one of them and call another row of leaves fruit.
  for (int u = 0; u < kWidth; ++u) {
    for (const int v : {10, 11, 12, 13}) frame.true_labels.at(u, v) = PixelLabel::ripe_fruit;
    for (const int v : {11, 12, 13, 14}) frame.labels.at(u, v) = PixelLabel::ripe_fruit;
  }
  MissionOptions options;
  options.detector.kind = "labels";
  Perception perception(options, DetectorRegistry::built_in());
  perception.move_field(Vec3::Zero());
  WorkMeter work;
  StageTimer timer;
  const auto seen = perception.observe(frame, Box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), work, timer);
  ASSERT_TRUE(seen);
  ASSERT_TRUE(seen->pixels);
  EXPECT_NEAR(seen->pixels->score().precision, 0.75, 1e-9);
  EXPECT_NEAR(seen->pixels->score().recall, 0.75, 1e-9);
}

}  // namespace
}  // namespace canopeer
