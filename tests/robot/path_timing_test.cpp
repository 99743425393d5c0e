#include "canopeer/robot/path_timing.h"

#include "canopeer/robot/straight_timing.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr double kSlack = 1e-9;  // what the header promises

JointLimits random_limits(Rng& random, int dof) {
  JointLimits limits;
  limits.lower = Configuration::Constant(dof, -9.0);
  limits.upper = Configuration::Constant(dof, 9.0);
  limits.velocity.resize(dof);
  limits.acceleration.resize(dof);
  for (int i = 0; i < dof; ++i) {
    limits.velocity[i] = random.uniform(0.2, 4.0);
    limits.acceleration[i] = random.uniform(0.2, 10.0);
  }
  return limits;
}

/// Waypoints of all sorts: some joints at rest, some waypoints close to each other, or repeated.
std::vector<Configuration> random_waypoints(Rng& random, int dof) {
  std::vector<Configuration> waypoints;
  const std::size_t count = 2 + random.index(5);
  const double size = random.chance(0.3) ? 0.05 : 2.0;
  for (std::size_t k = 0; k < count; ++k) {
    Configuration q = k == 0 ? Configuration(Configuration::Zero(dof)) : waypoints.back();
    if (!random.chance(0.05)) {
      for (double& joint : q) joint += random.chance(0.2) ? 0.0 : random.uniform(-size, size);
    }
    if (k >= 2 && random.chance(0.03)) q = waypoints[k - 2];  // back the way it came
    waypoints.push_back(q);
  }
  return waypoints;
}

double distance_to_corners(const std::vector<Configuration>& waypoints, const Configuration& q) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Configuration along = waypoints[i] - waypoints[i - 1];
    const double length2 = along.squaredNorm();
    const double s =
        length2 == 0.0 ? 0.0 : std::clamp((q - waypoints[i - 1]).dot(along) / length2, 0.0, 1.0);
    nearest = std::min(nearest, (q - waypoints[i - 1] - s * along).norm());
  }
  return nearest;
}

TEST(PathMotion, KeepsAllLimitsAtEveryInstantOnRandomPaths) {
  Rng random(1);
  for (int trial = 0; trial < 256000; ++trial) {
    const int dof = 1 + static_cast<int>(random.index(8));
    const JointLimits limits = random_limits(random, dof);
    const std::vector<Configuration> waypoints = random_waypoints(random, dof);
    PathTimingOptions options;
    options.max_deviation = random.chance(0.1) ? 0.0 : random.uniform(0.001, 0.3);
    options.arc_step_rad = 0.2;
    const PathMotion motion(waypoints, limits, options);
    ASSERT_TRUE(std::isfinite(motion.duration_s()));
    ASSERT_LT((motion.at(0.0) - waypoints.front()).norm(), 1e-12);
    ASSERT_EQ(motion.at(motion.duration_s()), waypoints.back());
    ASSERT_LT(motion.velocity_at(0.0).norm(), 1e-12);
    ASSERT_LT(motion.velocity_at(motion.duration_s()).norm(), 1e-6);
    for (int k = 0; k < 12; ++k) {
      const double t = random.uniform() * motion.duration_s();
      const Configuration v = motion.velocity_at(t);
      const Configuration a = motion.acceleration_at(t);
      for (int i = 0; i < dof; ++i) {
        ASSERT_LE(std::abs(v[i]), limits.velocity[i] * (1.0 + kSlack)) << "trial " << trial;
        ASSERT_LE(std::abs(a[i]), limits.acceleration[i] * (1.0 + kSlack)) << "trial " << trial;
      }
      ASSERT_LE(distance_to_corners(waypoints, motion.at(t)), options.max_deviation + 1e-9);
    }
  }
}

TEST(PathMotion, ItsVelocityAndAccelerationAreThoseOfItsPositions) {
  Rng random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const JointLimits limits = random_limits(random, 6);
    const PathMotion motion(random_waypoints(random, 6), limits);
    const double h = 1e-5;
    for (int k = 0; k < 20; ++k) {
      const double t = random.uniform() * motion.duration_s();
      if (t < h || t > motion.duration_s() - h) continue;
      const Configuration mean = (motion.at(t + h) - motion.at(t - h)) / (2.0 * h);
      // Accelerations are bounded, so means over 2h miss the velocity by no more than a · h.
      ASSERT_LT((mean - motion.velocity_at(t)).cwiseAbs().maxCoeff(),
                2.0 * limits.acceleration.maxCoeff() * h + 1e-7);
      const Configuration change =
          (motion.velocity_at(t + h) - motion.velocity_at(t - h)) / (2.0 * h);
      for (int i = 0; i < 6; ++i)
        ASSERT_LT(std::abs(change[i]), limits.acceleration[i] * (1.0 + 1e-6) + 1e-5);
    }
  }
}

TEST(PathMotion, OnAStraightLineIsAsFastAsTheClosedForm) {
  Rng random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const JointLimits limits = random_limits(random, 6);
    Configuration a(6);
    Configuration b(6);
    for (int i = 0; i < 6; ++i) {
      a[i] = random.uniform(-2.0, 2.0);
      b[i] = random.uniform(-2.0, 2.0);
    }
    const double best = motion_time(a, b, limits);
    const double ours = PathMotion({a, b}, limits).duration_s();
    EXPECT_GE(ours, best * (1.0 - 1e-9));
    EXPECT_LE(ours, best * (1.0 + 1e-6));
  }
}

TEST(PathMotion, RoundsCornersWhereThatIsFasterThanStopping) {
  Rng random(4);
  JointLimits equal = random_limits(random, 6);
  equal.velocity.setConstant(3.14);
  equal.acceleration.setConstant(1.0);
  double stopping = 0.0;
  double rounding = 0.0;
  double fine = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Configuration> waypoints;
    for (int k = 0; k < 5; ++k) {
      Configuration q(6);
      for (double& joint : q) joint = random.uniform(-1.5, 1.5);
      waypoints.push_back(q);
    }
    PathTimingOptions wide;
    wide.max_deviation = 0.2;
    const JointLimits any = random_limits(random, 6);
    double stop_any = 0.0;
    for (std::size_t k = 1; k < 5; ++k) {
      stopping += motion_time(waypoints[k - 1], waypoints[k], equal);
      stop_any += motion_time(waypoints[k - 1], waypoints[k], any);
    }
    EXPECT_LE(PathMotion(waypoints, any).duration_s(), stop_any * (1.0 + 1e-9));
    rounding += PathMotion(waypoints, equal, wide).duration_s();
    wide.arc_step_rad = 0.002;
    fine += PathMotion(waypoints, equal, wide).duration_s();
  }
  EXPECT_LT(rounding, 0.95 * stopping);
  EXPECT_LT(rounding, 1.01 * fine);  // the default grid costs little
}

TEST(PathMotion, OfOneWaypointStays) {
  Rng random(5);
  const Configuration q = Configuration::Constant(3, 0.5);
  const PathMotion motion({q, q, q}, random_limits(random, 3));
  EXPECT_EQ(motion.duration_s(), 0.0);
  EXPECT_EQ(motion.at(0.0), q);
  EXPECT_EQ(motion.velocity_at(1.0), Configuration::Zero(3));
}

}  // namespace
}  // namespace canopeer
