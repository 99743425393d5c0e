#include "canopeer/sensing/camera_twist.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

Vec3 random_vector(Rng& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

CameraIntrinsics random_camera(Rng& random) {
  CameraIntrinsics camera = CameraIntrinsics::from_fov(640, 480, random.uniform(0.6, 1.6));
  camera.fy *= random.uniform(0.9, 1.1);
  camera.cx += random.uniform(-30.0, 30.0);
  camera.cy += random.uniform(-30.0, 30.0);
  return camera;
}

/// Where the camera is after so many seconds of a steady twist, seen from where it was; to the
/// second order.
Pose moved(const CameraTwist& twist, double seconds) {
  const Vec3 turn = seconds * twist.angular;
  Pose T = Pose::Identity();
  T.translation() = seconds * twist.linear + 0.5 * seconds * turn.cross(twist.linear);
  if (turn.norm() > 0.0) T.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return T;
}

Eigen::Vector2d pixel(const CameraIntrinsics& camera, const Vec3& p_camera) {
  return {camera.fx * p_camera.x() / p_camera.z() + camera.cx,
          camera.fy * p_camera.y() / p_camera.z() + camera.cy};
}

TEST(ImageSpeed, IsThatOfPointsAsTheyAreSeenFromAMovingCamera) {
  Rng random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const CameraIntrinsics camera = random_camera(random);
    const double distance_m = random.uniform(0.2, 2.0);
    CameraTwist twist;
    if (!random.chance(0.2)) twist.linear = random_vector(random, 1.0);
    if (!random.chance(0.2)) twist.angular = random_vector(random, 2.0);
    constexpr double kStep = 1e-5;
    double fastest = 0.0;
    for (const double u : {0.0, 0.5, 1.0}) {
      for (const double v : {0.0, 0.5, 1.0}) {
        const Vec3 point(distance_m * (u * camera.width - camera.cx) / camera.fx,
                         distance_m * (v * camera.height - camera.cy) / camera.fy, distance_m);
        const Eigen::Vector2d after = pixel(camera, moved(twist, kStep).inverse() * point);
        const Eigen::Vector2d before = pixel(camera, moved(twist, -kStep).inverse() * point);
        fastest = std::max(fastest, (after - before).norm() / (2.0 * kStep));
      }
    }
    ASSERT_NEAR(image_speed(twist, camera, distance_m), fastest, 1e-5 * (1.0 + fastest))
        << "trial " << trial;
  }
}

TEST(ImageSpeed, IsANormOfTheTwist) {
  Rng random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const CameraIntrinsics camera = random_camera(random);
    const CameraTwist a{random_vector(random, 1.0), random_vector(random, 1.0)};
    const CameraTwist b{random_vector(random, 1.0), random_vector(random, 1.0)};
    const double factor = random.uniform(-3.0, 3.0);
    const double speed = image_speed(a, camera, 0.5);
    EXPECT_NEAR(image_speed({factor * a.linear, factor * a.angular}, camera, 0.5),
                std::abs(factor) * speed, 1e-9 * speed);
    EXPECT_LE(image_speed({a.linear + b.linear, a.angular + b.angular}, camera, 0.5),
              (speed + image_speed(b, camera, 0.5)) * (1.0 + 1e-12));
  }
  EXPECT_EQ(image_speed({}, CameraIntrinsics(), 0.5), 0.0);
}

TEST(ImageSpeed, OfASideStepIsFocalLengthTimesSpeedOverDistance) {
  const CameraIntrinsics camera = CameraIntrinsics::from_fov(640, 480, 1.4);
  EXPECT_NEAR(image_speed({{0.1, 0.0, 0.0}, Vec3::Zero()}, camera, 0.5), camera.fx * 0.2, 1e-9);
}

TEST(TwistBetween, LeadsFromOnePoseToTheNext) {
  Rng random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const CameraTwist twist{random_vector(random, 1.0), random_vector(random, 2.0)};
    const Pose start = moved({random_vector(random, 1.0), random_vector(random, 2.0)}, 1.0);
    constexpr double kStep = 1e-5;
    const CameraTwist found = twist_between(start, start * moved(twist, kStep), kStep);
    ASSERT_LT((found.linear - twist.linear).norm(), 1e-4);
    ASSERT_LT((found.angular - twist.angular).norm(), 1e-4);
  }
  EXPECT_EQ(twist_between(Pose::Identity(), Pose::Identity(), 0.0).linear.norm(), 0.0);
}

}  // namespace
}  // namespace canopeer
