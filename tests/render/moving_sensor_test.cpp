#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "canopeer/render/motion/linear_light.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

constexpr double kNear = 1.0;  // m, of the board
constexpr double kFar = 2.0;   // m, of the wall behind it
constexpr Rgb kBright{220, 180, 90};
constexpr Rgb kDark{20, 40, 60};

/// Light of a colour's green, 0 … 1.
double light(const Rgb& color) { return linear_light().of(color.g) / 65535.0; }

ScenePart slab(double x, double y_from, double y_to, Rgb color) {
  ScenePart part;
  part.mesh = make_box(Box(Vec3(x, y_from, -9), Vec3(x + 0.1, y_to, 9)));
  compute_normals(part.mesh);
  part.kind = PartClass::support;
  part.color = color;
  return part;
}

/// A bright board whose upright edge at y = 0 stands before a dark wall, and a camera at the origin
/// that looks along x and pans to the left, which is +y.
struct Pan {
  Scene scene;
  std::unique_ptr<Renderer> renderer;
  RgbdSensorOptions options;
  double rad_s = 0.0;

  Pan() {
    scene.parts = {slab(kNear, -9, 0, kBright), slab(kFar, -9, 9, kDark)};
    RenderOptions light;
    light.ambient = 1.0;
    light.color_noise = 0.0;
    renderer = std::make_unique<Renderer>(scene, light);
    options.intrinsics = CameraIntrinsics::from_fov(320, 120, 1.2);
  }
  [[nodiscard]] static Pose at_angle(double angle) {
    return look_at(Vec3::Zero(), Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  [[nodiscard]] CameraTrack track() const {
    return [this](double t) { return at_angle(rad_s * t); };
  }
  [[nodiscard]] RgbdFrame capture() const {
    return RgbdSensor(*renderer, scene, options).capture_moving(track(), 0.0, 0);
  }
  /// Light of the wall and of the board where nothing is blurred.
  [[nodiscard]] double of_wall(const RgbdFrame& frame) const {
    return light(frame.color.at(2, 60));
  }
  [[nodiscard]] double of_board(const RgbdFrame& frame) const {
    return light(frame.color.at(317, 60));
  }
  /// Speed of the image in the middle of it.
  void set_speed(double px_s) { rad_s = px_s / options.intrinsics.fx; }
  /// When the pixel's centre looks past the edge at y = 0; before, it sees the board. Exact for
  /// every row: the camera turns about an upright axis.
  [[nodiscard]] double passes_edge_at(int u) const {
    return std::atan((u + 0.5 - options.intrinsics.cx) / options.intrinsics.fx) / rad_s;
  }
};

TEST(MovingSensor, AStepIsBlurredBySpeedTimesExposureInLinearLight) {
  for (const double px : {0.8, 2.0, 3.7, 6.0, 12.5}) {
    for (const double exposure : {0.002, 0.01}) {
      Pan pan;
      pan.options.motion.exposure_s = exposure;
      pan.options.motion.sub_frames = 31;
      pan.set_speed(px / exposure);
      const RgbdFrame frame = pan.capture();
      const double board = pan.of_board(frame);
      const double wall = pan.of_wall(frame);
      ASSERT_GT(board, wall + 0.1);
      int mixed = 0;
      double gathered = 0.0;
      double exact = 0.0;
      for (int u = 0; u < frame.color.width(); ++u) {
        const double seen = light(frame.color.at(u, 60));
        const double share = std::clamp(pan.passes_edge_at(u) / exposure + 0.5, 0.0, 1.0);
        const double expected = share * board + (1.0 - share) * wall;
        // Sub-frames lie up to a pixel apart: off by half of one of them, and by 8-bit steps.
        const double part = 0.5 / std::max(3.0, std::ceil(px));
        EXPECT_NEAR(seen, expected, part * (board - wall) + 0.005) << px << " px, pixel " << u;
        if (std::abs(u - 160) > 10) continue;  // elsewhere highlights add up
        gathered += seen;
        exact += expected;
        mixed += seen < board && seen > wall;
      }
      EXPECT_NEAR(mixed, px, 1.5);
      EXPECT_NEAR(gathered, exact, 0.5 * (board - wall));
    }
  }
}

TEST(MovingSensor, ManySubFramesComeToTheExactIntegral) {
  Pan pan;
  pan.options.motion.exposure_s = 0.01;
  pan.options.motion.sub_frames = 255;
  pan.set_speed(250.0 / 0.01);
  const RgbdFrame frame = pan.capture();
  for (int u = 100; u < 220; ++u) {
    const double share = pan.passes_edge_at(u) / 0.01 + 0.5;
    const double expected = share * pan.of_board(frame) + (1.0 - share) * pan.of_wall(frame);
    EXPECT_NEAR(light(frame.color.at(u, 60)), expected, 0.006);
  }
}

/// The column where the board begins, by depth or by colour.
int edge_column(const RgbdFrame& frame, int v, bool by_depth) {
  for (int u = 0; u < frame.depth.width(); ++u) {
    if (by_depth ? frame.depth.at(u, v) < 1.5F : frame.color.at(u, v).r > 100) return u;
  }
  return -1;
}

TEST(MovingSensor, ARollingShutterSlantsAnUprightEdgeBySpeedTimesReadout) {
  for (const bool depth_rolls : {true, false}) {
    Pan pan;
    pan.options.motion.readout_s = 0.02;
    pan.options.motion.depth_rolls = depth_rolls;
    pan.options.motion.sub_frames = 31;
    pan.set_speed(20.0 / 0.02);
    const RgbdFrame frame = pan.capture();
    for (int v = 0; v < 120; v += 7) {
      const double t = (v / 119.0 - 0.5) * 0.02;
      const double column = 160.0 + pan.options.intrinsics.fx * std::tan(pan.rad_s * t);
      // Half a sub-frame, less than a pixel apart, and half a pixel.
      EXPECT_NEAR(edge_column(frame, v, false), column, 1.01);
      EXPECT_NEAR(edge_column(frame, v, true), depth_rolls ? column : 160.0, 1.01);
    }
    EXPECT_NEAR(edge_column(frame, 119, false) - edge_column(frame, 0, false), 20, 1.5);
  }
}

TEST(MovingSensor, DepthAtAMovingEdgeIsThatOfOneOfTheSurfacesByHowLongItWasSeen) {
  Pan pan;
  pan.options.motion.exposure_s = 0.01;
  pan.set_speed(8.0 / 0.01);
  const RgbdFrame frame = pan.capture();
  for (int u = 0; u < 320; ++u) {
    int near = 0;
    for (int v = 0; v < 120; ++v) {
      const double z = static_cast<double>(frame.depth.at(u, v));
      const double half = pan.options.intrinsics.fx;  // tan of the ray's angle times this
      const double slant = std::abs(u + 0.5 - 160.0) / half * pan.rad_s * 0.01;
      ASSERT_TRUE(std::abs(z - kNear) < 0.02 + slant || std::abs(z - kFar) < 0.04 + 2 * slant) << z;
      near += z < 1.5;
    }
    const double share = std::clamp(pan.passes_edge_at(u) / 0.01 + 0.5, 0.0, 1.0);
    // A sub-frame more or less, and four standard deviations of 120 draws.
    EXPECT_NEAR(near / 120.0, share, 1.0 / 9 + 4 * std::sqrt(0.25 / 120)) << u;
    if (share > 0.0 && share < 1.0) continue;
    EXPECT_EQ(near, share >= 1.0 ? 120 : 0);
  }
}

/// Looks at a row of Scenario 1.
struct RowOfPlants {
  Scene scene = make_world(scenario_1_world(), 1);
  Renderer renderer{scene};
  RgbdSensorOptions options;

  RowOfPlants() { options.intrinsics = CameraIntrinsics::from_fov(320, 240, 1.4); }
  [[nodiscard]] static Pose pose(double y = 0.25) {
    return look_at(Vec3(-0.1, y, 0.9), Vec3(0.75, y, 0.5));
  }
};

bool same_images(const RgbdFrame& a, const RgbdFrame& b) {
  return a.depth.pixels() == b.depth.pixels() && a.color.pixels() == b.color.pixels() &&
         a.labels.pixels() == b.labels.pixels() && a.true_labels.pixels() == b.true_labels.pixels();
}

TEST(MovingSensor, AtRestItShowsWhatCaptureShowsToTheByte) {
  RowOfPlants row;
  row.options.noise = sensor_noise_preset("d435");
  row.options.label_noise = 0.3;
  row.options.hand_eye_translation_m = 0.003;
  const RgbdFrame before = RgbdSensor(row.renderer, row.scene, row.options).capture(row.pose(), 3);
  for (const std::string& name : camera_motion_names()) {
    row.options.motion = camera_motion_preset(name);
    const RgbdSensor sensor(row.renderer, row.scene, row.options);
    const CameraTrack still = [&](double) { return row.pose(); };
    const RgbdFrame frame = sensor.capture_moving(still, 12.5, 3);
    EXPECT_TRUE(same_images(frame, before)) << name;
    EXPECT_TRUE(same_images(sensor.capture(row.pose(), 3), before)) << name;
    EXPECT_EQ(frame.time_s, sensor.stamp_of(12.5, 3));
    EXPECT_EQ(frame.T_world_camera.matrix(), row.pose().matrix());
  }
}

TEST(MovingSensor, WithMotionOffItIsCaptureWhereTheTrackSays) {
  const RowOfPlants row;
  const RgbdSensor sensor(row.renderer, row.scene, row.options);
  const CameraTrack track = [&](double t) { return row.pose(0.5 * t); };
  const RgbdFrame frame = sensor.capture_moving(track, 0.5, 3);
  EXPECT_TRUE(same_images(frame, sensor.capture(row.pose(0.25), 3)));
  EXPECT_EQ(frame.time_s, 0.5);
  EXPECT_EQ(frame.T_world_camera.matrix(), row.pose(0.25).matrix());
}

TEST(MovingSensor, AFrameBearsThePoseOfItsStampAndShowsWhatWasThere) {
  RowOfPlants row;
  const CameraTrack track = [&](double t) { return row.pose(0.5 * t); };
  row.options.motion.exposure_s = 0.008;
  const RgbdFrame right =
      RgbdSensor(row.renderer, row.scene, row.options).capture_moving(track, 0.5, 3);
  row.options.motion.stamp_offset_s = 0.03;
  const RgbdSensor late(row.renderer, row.scene, row.options);
  const RgbdFrame frame = late.capture_moving(track, 0.5, 3);
  EXPECT_EQ(late.stamp_of(0.5, 3), 0.53);
  EXPECT_EQ(frame.time_s, 0.53);
  EXPECT_EQ(frame.T_world_camera.matrix(), track(0.53).matrix());
  EXPECT_TRUE(frame.color.pixels() == right.color.pixels());
  EXPECT_TRUE(frame.labels.pixels() == right.labels.pixels());
}

TEST(MovingSensor, AnyNumberOfThreadsGivesTheSameFrame) {
  RowOfPlants row;
  row.options.noise = sensor_noise_preset("d435");
  row.options.motion = camera_motion_preset("d435");
  const RgbdSensor sensor(row.renderer, row.scene, row.options);
  const CameraTrack track = [&](double t) { return row.pose(0.3 * t); };
  const RgbdFrame frame = sensor.capture_moving(track, 0.8, 1);
  EXPECT_FALSE(same_images(frame, sensor.capture(row.pose(0.24), 1)));
  for (const int threads : {1, 2, 3}) {
    RgbdFrame again;
    oneapi::tbb::task_arena(threads).execute([&] { again = sensor.capture_moving(track, 0.8, 1); });
    EXPECT_TRUE(same_images(again, frame)) << threads;
    EXPECT_EQ(again.time_s, frame.time_s);
  }
}

TEST(MovingSensor, ALensIsBlurredLikeAPinhole) {
  Pan pan;
  pan.options.motion.exposure_s = 0.01;
  pan.set_speed(6.0 / 0.01);
  const RgbdFrame pinhole = pan.capture();
  pan.options.lens = {-0.05, 0.01, 0.0, 0.0, 0.0};
  const RgbdFrame lens = pan.capture();
  for (int u = 100; u < 220; ++u) {
    EXPECT_NEAR(light(lens.color.at(u, 60)), light(pinhole.color.at(u, 60)), 0.12) << u;
  }
}

}  // namespace
}  // namespace canopeer
