// Motions under a limit on image motion.

#include <cmath>

#include "canopeer/robot/corner_rounding.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/straight_timing.h"
#include "canopeer/robot/timing/image_motion.h"
#include "canopeer/sensing/camera_twist.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

/// An arm of six joints, and one of seven on a rail.
const std::vector<const RobotModel*>& robots() {
  static const Expected<RobotModel> rail =
      load_robot(CANOPEER_SOURCE_DIR "/robots/panda_rail/robot.yaml");
  if (!rail) ADD_FAILURE() << rail.error().message;
  static const std::vector<const RobotModel*> all = {&shipped_robot(), &*rail};
  return all;
}

ImageMotionLimit random_limit(Rng& random) {
  ImageMotionLimit limit;
  limit.camera = CameraIntrinsics::from_fov(640, 480, random.uniform(0.7, 1.6));
  limit.distance_m = random.uniform(0.2, 1.2);
  limit.speed_px_s = 10.0 * std::pow(200.0, random.uniform());
  return limit;
}

/// Lines and arcs of all sizes; some joints stand still, some corners are stopped at.
JointPath random_path(Rng& random, const RobotModel& robot) {
  JointPath path;
  path.waypoints.push_back(random_configuration(random, robot));
  const double size = random.chance(0.3) ? 0.05 : random.uniform(0.1, 1.5);
  for (std::size_t k = 0, count = 1 + random.index(4); k < count; ++k) {
    Configuration q = path.waypoints.back();
    for (double& joint : q) joint += random.chance(0.2) ? 0.0 : random.uniform(-size, size);
    path.waypoints.push_back(q);
  }
  if (random.chance(0.7)) {
    for (std::size_t k = 0; k < path.waypoints.size(); ++k)
      path.deviations.push_back(random.chance(0.2) ? 0.0 : random.uniform(0.001, 0.4));
  }
  path.sharp = random_limit(random);
  return path;
}

/// How fast the image truly moves, from the camera's poses a little before and after.
double true_image_speed(const RobotModel& robot, const PathMotion& motion, double t_s,
                        const ImageMotionLimit& limit) {
  constexpr double kStep = 1e-5;
  const Pose before = robot.T_base_camera(motion.at(t_s - kStep));
  const Pose after = robot.T_base_camera(motion.at(t_s + kStep));
  const Pose now = robot.T_base_camera(motion.at(t_s));
  CameraTwist twist = twist_between(before, after, 2.0 * kStep);
  twist.linear =
      now.linear().transpose() * (after.translation() - before.translation()) / (2.0 * kStep);
  return image_speed(twist, limit.camera, limit.distance_m);
}

TEST(SharpTiming, KeepsAllLimitsAtEveryInstantOnRandomPaths) {
  Rng random(1);
  int limited = 0;
  double nearest = 0.0;
  for (int trial = 0; trial < 3000; ++trial) {
    const RobotModel& robot = *robots()[random.index(2)];
    const JointLimits& limits = robot.limits();
    const JointPath path = random_path(random, robot);
    const PathMotion motion(path, robot);
    const double duration_s = motion.duration_s();
    ASSERT_TRUE(std::isfinite(duration_s));
    ASSERT_EQ(motion.at(duration_s), path.waypoints.back());
    const double unlimited_s = PathMotion(path, limits).duration_s();
    // Arcs are cut more finely where image motion limits, which may save what the coarse grid gives
    // away: then a fine one judges.
    if (duration_s < unlimited_s * (1.0 - 1e-9)) {
      ASSERT_FALSE(path.deviations.empty());
      ASSERT_GE(duration_s, PathMotion(path, limits, 0.002).duration_s()) << "trial " << trial;
    }
    if (duration_s > 1.01 * unlimited_s) ++limited;
    for (int k = 0; k < 20; ++k) {
      const double t_s = random.uniform() * duration_s;
      const Configuration v = motion.velocity_at(t_s);
      const Configuration a = motion.acceleration_at(t_s);
      ASSERT_TRUE((v.array().abs() <= limits.velocity.array() * (1.0 + 1e-9)).all());
      ASSERT_TRUE((a.array().abs() <= limits.acceleration.array() * (1.0 + 1e-9)).all());
      const double speed = true_image_speed(robot, motion, t_s, *path.sharp);
      ASSERT_LE(speed, path.sharp->speed_px_s * (1.0 + 1e-6)) << "trial " << trial;
      nearest = std::max(nearest, speed / path.sharp->speed_px_s);
    }
  }
  EXPECT_GT(limited, 1500);
  EXPECT_GT(nearest, 0.99);
}

TEST(SharpTiming, GivesAwayLittleSpeed) {
  Rng random(2);
  double sum = 0.0;
  double worst = 0.0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RobotModel& robot = *robots()[random.index(2)];
    const JointPath path = random_path(random, robot);
    PathTimingOptions fine;
    fine.arc_step_rad /= 10.0;
    fine.image_step /= 10.0;
    const double ratio =
        PathMotion(path, robot).duration_s() / PathMotion(path, robot, fine).duration_s();
    sum += ratio;
    worst = std::max(worst, ratio);
    ASSERT_LE(ratio, 1.05) << "trial " << trial;
  }
  RecordProperty("mean", std::to_string(sum / kTrials));
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(sum / kTrials, 1.02);
}

TEST(SharpTiming, AGenerousLimitChangesNothing) {
  Rng random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const RobotModel& robot = *robots()[random.index(2)];
    JointPath path = random_path(random, robot);
    path.sharp->speed_px_s = 1e9;
    const PathMotion motion(path, robot);
    const PathMotion unlimited(path, robot.limits());
    ASSERT_EQ(motion.duration_s(), unlimited.duration_s());
    const double t_s = random.uniform() * motion.duration_s();
    ASSERT_EQ(motion.at(t_s), unlimited.at(t_s));
    ASSERT_EQ(motion_time(path, robot), motion.duration_s());
    path.sharp.reset();
    ASSERT_EQ(PathMotion(path, robot).duration_s(), unlimited.duration_s());
    ASSERT_EQ(motion_time(path, robot), motion_time(path, robot.limits()));
  }
}

TEST(SharpTiming, HalfTheSpeedTakesNoMoreThanTwiceTheTime) {
  Rng random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const RobotModel& robot = *robots()[random.index(2)];
    JointPath path = random_path(random, robot);
    const double quick_s = motion_time(path, robot);
    path.sharp->speed_px_s /= 2.0;
    const double slow_s = motion_time(path, robot);
    ASSERT_GE(slow_s, quick_s * (1.0 - 1e-9));
    ASSERT_LE(slow_s, 2.05 * quick_s);
  }
}

TEST(SharpTiming, ABoundHoldsBetweenThePlacesThatAreLookedAt) {
  Rng random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    const RobotModel& robot = *robots()[random.index(2)];
    const JointPath path = random_path(random, robot);
    const ImageMotion image(robot, *path.sharp);
    const BlendedPath blended(path);
    for (const BlendedPath::Piece& piece : blended.pieces()) {
      const double begin = piece.begin + random.uniform(0.0, 0.9) * piece.length;
      const double length = std::min(random.uniform(0.01, 0.6), piece.begin + piece.length - begin);
      const auto along = [&](double s) {
        return image.along(BlendedPath::point(piece, s), BlendedPath::tangent(piece, s));
      };
      const double bound =
          std::max(along(begin), along(begin + length)) + image.bend(piece) * length * length / 8.0;
      for (const double share : {0.25, 0.5, 0.75})
        ASSERT_LE(along(begin + share * length), bound) << "trial " << trial;
    }
  }
}

TEST(SharpTiming, AnEdgeCostsAboutWhatItsMotionTakes) {
  Rng random(6);
  double sum = 0.0;
  double worst = 0.0;
  int limited = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const RobotModel& robot = *robots()[random.index(2)];
    JointPath path = random_path(random, robot);
    path.waypoints.resize(2);
    path.deviations.clear();
    const Configuration& a = path.waypoints.front();
    const Configuration& b = path.waypoints.back();
    const double true_s = motion_time(path, robot);
    if (true_s == 0.0) continue;
    const double estimate_s = straight_motion_time(a, b, robot, path.sharp);
    ASSERT_GE(estimate_s, motion_time(a, b, robot.limits()));
    ASSERT_NEAR(straight_motion_time(b, a, robot, path.sharp), estimate_s, 1e-9 * estimate_s);
    ASSERT_EQ(straight_motion_time(a, b, robot, std::nullopt), motion_time(a, b, robot.limits()));
    if (true_s < 1.01 * motion_time(a, b, robot.limits())) continue;
    ++limited;
    const double error = std::abs(estimate_s / true_s - 1.0);
    sum += error;
    worst = std::max(worst, error);
    ASSERT_LT(error, 0.1) << "trial " << trial;
  }
  RecordProperty("mean", std::to_string(sum / limited));
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(limited, 2000);
  EXPECT_LT(sum / limited, 0.02);
}

TEST(SharpTiming, CornersAreRoundedWhereThatIsFasterUnderTheLimit) {
  Rng random(7);
  const CollisionChecker nothing_around(shipped_robot(), {});
  const RobotModel& robot = shipped_robot();
  int rounded = 0;
  for (int trial = 0; trial < 60; ++trial) {
    JointPath path;
    for (int k = 0; k < 4; ++k) {
      Configuration q = robot.home("side_1");
      for (double& joint : q) joint += random.uniform(-0.4, 0.4);
      path.waypoints.push_back(q);
    }
    path.sharp = random_limit(random);
    int states = 0;
    const JointPath way = round_corners(path, robot, nothing_around, states);
    ASSERT_TRUE(way.sharp.has_value());
    EXPECT_EQ(way.sharp->speed_px_s, path.sharp->speed_px_s);
    EXPECT_LE(motion_time(way, robot), motion_time(path, robot) * (1.0 + 1e-9));
    if (!way.deviations.empty()) ++rounded;
    path.sharp.reset();
    const JointPath free_way = round_corners(path, robot, nothing_around, states);
    EXPECT_EQ(free_way.deviations,
              round_corners(path.waypoints, robot.limits(), nothing_around, states).deviations);
  }
  EXPECT_GT(rounded, 20);
}

}  // namespace
}  // namespace canopeer
