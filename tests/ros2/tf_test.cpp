// Frames of tf: chains, times, and what is missing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "canopeer/ros2/camera/tf_buffer.h"

namespace canopeer::ros {
namespace {

constexpr Stamp kStart = 100 * kNanosecondsPerSecond;
constexpr double kPi = std::numbers::pi;

Pose turned(double x, double angle) {
  Pose pose(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  pose.translation() = Vec3(x, 0.0, 0.0);
  return pose;
}

tf2_msgs::TFMessage step(const std::string& parent, const std::string& child, double time_s,
                         const Pose& T_parent_child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = ros_time(kStart + nanoseconds(time_s));
  transform.child_frame_id = child;
  const Vec3 p = T_parent_child.translation();
  const Eigen::Quaterniond q(T_parent_child.linear());
  transform.transform.translation = {p.x(), p.y(), p.z()};
  transform.transform.rotation = {q.x(), q.y(), q.z(), q.w()};
  return {{transform}};
}

Stamp at(double time_s) { return kStart + nanoseconds(time_s); }

/// base → arm moves; arm → camera and base → tag stand still.
void fill(TfBuffer& tf) {
  tf.add(step("arm", "camera", 0.0, turned(0.5, kPi / 2)), true);
  tf.add(step("base", "tag", 0.0, turned(3.0, 0.0)), true);
  for (int i = 0; i <= 10; ++i) {
    tf.add(step("base", "arm", 0.1 * i, turned(0.1 * i, 0.02 * i)), false);
  }
}

TEST(TfBuffer, WalksUpAndDownTheTreeAtATimeInBetween) {
  TfBuffer tf;
  fill(tf);
  const auto T_base_camera = tf.lookup("base", "camera", at(0.55));
  ASSERT_TRUE(T_base_camera) << T_base_camera.error().message;
  EXPECT_TRUE(T_base_camera->isApprox(turned(0.55, 0.11) * turned(0.5, kPi / 2), 1e-9));
  const auto T_camera_tag = tf.lookup("/camera", "tag", at(0.55));
  ASSERT_TRUE(T_camera_tag);
  EXPECT_TRUE(T_camera_tag->isApprox(T_base_camera->inverse() * turned(3.0, 0.0), 1e-9));
  EXPECT_TRUE(tf.lookup("tag", "base", at(50.0)));  // static
  EXPECT_TRUE(tf.newest("base", "camera")->isApprox(turned(1.0, 0.2) * turned(0.5, kPi / 2), 1e-9));
  EXPECT_EQ(tf.known_until("camera", "tag"), at(1.0));
  EXPECT_FALSE(tf.known_until("tag", "base"));
}

TEST(TfBuffer, SaysWhatIsMissing) {
  TfBuffer tf;
  fill(tf);
  tf.add(step("odom", "wheel", 0.0, turned(1, 0)), false);
  EXPECT_NE(tf.lookup("base", "lens", at(0.5)).error().message.find("no frame 'lens'"),
            std::string::npos);
  EXPECT_NE(tf.lookup("base", "wheel", at(0.5)).error().message.find("two trees, under 'base'"),
            std::string::npos);
  EXPECT_NE(tf.lookup("base", "camera", at(1.25)).error().message.find("up to 0.250 s before"),
            std::string::npos);
  EXPECT_NE(tf.lookup("base", "camera", at(-0.5)).error().message.find("0.500 s after"),
            std::string::npos);
  EXPECT_TRUE(tf.has("camera"));
  EXPECT_FALSE(tf.has("lens"));
}

TEST(TfBuffer, WhatMakesNoSenseIsPassedOver) {
  TfBuffer tf;
  auto bad = step("base", "arm", 0.0, turned(1, 0));
  bad.transforms[0].transform.translation.x = NAN;
  tf.add(bad, false);
  bad = step("base", "arm", 0.0, turned(1, 0));
  bad.transforms[0].transform.rotation = {0, 0, 0, 0};
  tf.add(bad, false);
  tf.add(step("base", "base", 0.0, turned(1, 0)), false);
  tf.add(step("", "arm", 0.0, turned(1, 0)), false);
  tf.add(step("base", std::string(257, 'x'), 0.0, turned(1, 0)), false);
  EXPECT_EQ(tf.malformed(), 5);
  EXPECT_TRUE(tf.frames().empty());
  tf.add(step("a", "b", 0.0, turned(1, 0)), false);  // a circle ends
  tf.add(step("b", "a", 0.0, turned(1, 0)), false);
  EXPECT_FALSE(tf.lookup("a", "c", at(0.0)));
  static_cast<void>(tf.lookup("a", "b", at(0.0)));
}

TEST(TfBuffer, ForgetsWhatIsOldAndBeginsAnewWithTheClock) {
  TfBuffer tf(1.0);
  for (int i = 0; i < 50; ++i) tf.add(step("base", "arm", 0.1 * i, turned(i, 0)), false);
  EXPECT_FALSE(tf.lookup("base", "arm", at(3.5)));
  EXPECT_TRUE(tf.lookup("base", "arm", at(4.5)));
  tf.add(step("base", "arm", 4.85, turned(7, 0)), false);  // overtaken by another: left out
  EXPECT_NEAR(tf.newest("base", "arm")->translation().x(), 49.0, 1e-9);
  tf.add(step("base", "arm", -50.0, turned(7, 0)), false);
  EXPECT_NEAR(tf.newest("base", "arm")->translation().x(), 7.0, 1e-9);
  tf.add(step("world", "arm", 1.0, turned(8, 0)), false);  // hangs elsewhere now
  EXPECT_FALSE(tf.newest("base", "arm"));
}

TEST(TfBuffer, SaysNothingWithinALongGap) {
  TfBuffer tf;
  for (const double time : {0.0, 0.5, 1.1})
    tf.add(step("base", "arm", time, turned(time, 0)), false);
  EXPECT_TRUE(tf.lookup("base", "arm", at(0.25)));
  EXPECT_TRUE(tf.lookup("base", "arm", at(1.1)));
  const auto within = tf.lookup("base", "arm", at(0.8));
  ASSERT_FALSE(within);
  EXPECT_NE(within.error().message.find("nothing of 'arm' in 'base' for 0.600 s"),
            std::string::npos)
      << within.error().message;
}

TEST(TfBuffer, TheLongestLosesItsOldestWhenAllHoldTooMuch) {
  TfBuffer tf(1e6, 2000);
  tf.add(step("base", "slow", 0.0, turned(1, 0)), false);
  for (int i = 0; i < 3000; ++i) tf.add(step("base", "fast", 0.1 * i, turned(i, 0)), false);
  EXPECT_TRUE(tf.lookup("base", "slow", at(0.0)));
  EXPECT_FALSE(tf.lookup("base", "fast", at(100.0)));
  EXPECT_TRUE(tf.lookup("base", "fast", at(100.2)));  // 1999 samples up to 299.9 s
}

}  // namespace
}  // namespace canopeer::ros
