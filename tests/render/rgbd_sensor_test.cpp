#include "canopeer/render/rgbd_sensor.h"

#include <gtest/gtest.h>

#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

/// Looks at a row of Scenario 1.
struct Row {
  Scene scene = make_world(scenario_1_world(), 1);
  Renderer renderer{scene};
  Pose pose = look_at(Vec3(-0.1, 0.25, 0.9), Vec3(0.75, 0.25, 0.5));
  RgbdSensorOptions options;

  Row() { options.intrinsics = CameraIntrinsics::from_fov(320, 240, 1.4); }
  RgbdFrame capture(std::uint64_t number = 0) const {
    return RgbdSensor(renderer, scene, options).capture(pose, number);
  }
};

TEST(RgbdSensor, WithoutFaultsItDeliversWhatTheRendererShows) {
  const Row row;
  const RgbdFrame frame = row.capture();
  const RenderedView view = row.renderer.render(row.options.intrinsics, row.pose);
  EXPECT_TRUE(frame.depth.pixels() == view.depth.pixels());
  EXPECT_TRUE(frame.color.pixels() == view.color.pixels());
  int counted = 0;
  for (std::size_t i = 0; i < frame.labels.pixels().size(); ++i) {
    const int fruit = view.labels.fruit.pixels()[i];
    const bool truth = fruit >= 0 && row.scene.fruits[static_cast<std::size_t>(fruit)].counted;
    ASSERT_EQ(counted_fruit(frame.labels.pixels()[i]), truth);
    counted += truth;
  }
  EXPECT_GT(counted, 300);
}

TEST(RgbdSensor, LabelsAreWrongWithTheGivenProbability) {
  Row row;
  const RgbdFrame right = row.capture();
  row.options.label_noise = 0.3;
  const RgbdFrame frame = row.capture();
  int fruit = 0;
  int fruit_lost = 0;
  int other = 0;
  int other_called_fruit = 0;
  for (std::size_t i = 0; i < frame.labels.pixels().size(); ++i) {
    const bool truth = right.labels.pixels()[i] != PixelLabel::background;
    const bool said = frame.labels.pixels()[i] != PixelLabel::background;
    (truth ? fruit : other) += 1;
    fruit_lost += truth && !said;
    other_called_fruit += !truth && said;
  }
  EXPECT_NEAR(fruit_lost, 0.3 * fruit, 0.05 * fruit);
  EXPECT_NEAR(other_called_fruit, 0.3 * other, 0.01 * other);
  // The right ones are kept for scoring.
  EXPECT_TRUE(frame.true_labels.pixels() == right.labels.pixels());
  EXPECT_EQ(right.true_labels.width(), 0);
}

TEST(RgbdSensor, NoiseDiffersFromFrameToFrameAndRepeatsWithTheSeed) {
  Row row;
  row.options.noise = sensor_noise_preset("d435");
  row.options.label_noise = 0.3;
  const RgbdFrame a = row.capture(4);
  const RgbdFrame b = row.capture(4);
  EXPECT_TRUE(a.depth.pixels() == b.depth.pixels());
  EXPECT_TRUE(a.color.pixels() == b.color.pixels());
  EXPECT_TRUE(a.labels.pixels() == b.labels.pixels());
  EXPECT_FALSE(a.depth.pixels() == row.capture(5).depth.pixels());
  row.options.seed = 2;
  EXPECT_FALSE(a.depth.pixels() == row.capture(4).depth.pixels());
}

TEST(RgbdSensor, ARectifiedLensShowsThePinholesPictureToAPixel) {
  Row row;
  const RgbdFrame pinhole = row.capture();
  row.options.lens = {-0.12, 0.03, 0.0008, -0.0006, 0.0};
  const RgbdFrame rectified = row.capture();
  row.options.rectify = false;
  const RgbdFrame raw = row.capture();
  const auto agreeing = [&](const RgbdFrame& frame) {
    int same = 0;
    for (std::size_t i = 0; i < frame.depth.pixels().size(); ++i) {
      same += std::abs(frame.depth.pixels()[i] - pinhole.depth.pixels()[i]) < 0.005F;
    }
    return same / static_cast<double>(frame.depth.pixels().size());
  };
  EXPECT_GT(agreeing(rectified), 0.85);
  EXPECT_LT(agreeing(raw), agreeing(rectified) - 0.1);
}

TEST(RgbdSensor, TheHandEyeErrorIsOneForTheWholeRunAndOfTheGivenSize) {
  Row row;
  row.options.hand_eye_translation_m = 0.004;
  row.options.hand_eye_rotation_rad = 0.01;
  double squares = 0.0;
  double angles = 0.0;
  constexpr int kSeeds = 400;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    row.options.seed = seed;
    const RgbdSensor sensor(row.renderer, row.scene, row.options);
    squares += sensor.hand_eye_error().translation().squaredNorm();
    const double angle = Eigen::AngleAxisd(sensor.hand_eye_error().linear()).angle();
    angles += angle * angle;
  }
  EXPECT_NEAR(std::sqrt(squares / kSeeds), 0.004, 0.0005);
  EXPECT_NEAR(std::sqrt(angles / kSeeds), 0.01, 0.00125);
  // The frame claims the calibrated pose but shows what is seen from the true one.
  row.options.seed = 3;
  const RgbdSensor sensor(row.renderer, row.scene, row.options);
  const RgbdFrame frame = sensor.capture(row.pose, 0);
  EXPECT_TRUE(frame.T_world_camera.isApprox(row.pose));
  const RenderedView view =
      row.renderer.render(row.options.intrinsics, row.pose * sensor.hand_eye_error());
  EXPECT_TRUE(frame.depth.pixels() == view.depth.pixels());
}

}  // namespace
}  // namespace canopeer
