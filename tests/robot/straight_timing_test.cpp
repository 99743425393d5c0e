#include "canopeer/robot/straight_timing.h"

#include "robot_fixture.h"

namespace canopeer {
namespace {

JointLimits random_limits(Rng& random) {
  JointLimits limits;
  limits.lower = Configuration::Constant(6, -7.0);
  limits.upper = Configuration::Constant(6, 7.0);
  limits.velocity.resize(6);
  limits.acceleration.resize(6);
  for (int i = 0; i < 6; ++i) {
    limits.velocity[i] = random.uniform(0.2, 4.0);
    limits.acceleration[i] = random.uniform(0.2, 10.0);
  }
  return limits;
}

Configuration random_q(Rng& random) {
  Configuration q(6);
  for (double& joint : q) joint = random.chance(0.2) ? 0.0 : random.uniform(-3.0, 3.0);
  return q;
}

/// Least time from rest to rest over s = 0 … 1 by brute force over the cruise rate: the slower the
/// cruise the shorter the ramps, so the best allowed one must be found by the closed form.
double brute_force_time(double rate_limit, double acceleration_limit) {
  double best = 1e9;
  for (int k = 1; k <= 4000; ++k) {
    const double rate = rate_limit * k / 4000.0;
    const double ramp_s = rate / acceleration_limit;
    const double cruise = 1.0 - rate * ramp_s;  // what the two ramps leave
    if (cruise < 0.0) break;
    best = std::min(best, 2.0 * ramp_s + cruise / rate);
  }
  return best;
}

TEST(StraightMotion, KeepsTheLimitsAndStopsAtBothEnds) {
  Rng random(1);
  for (int trial = 0; trial < 10000; ++trial) {
    const JointLimits limits = random_limits(random);
    const Configuration a = random_q(random);
    const Configuration b = random_q(random);
    const StraightMotion motion(a, b, limits);
    const double duration = motion.duration_s();
    ASSERT_EQ(motion.at(duration), b);
    ASSERT_LT((motion.at(0.0) - a).norm(), 1e-12);
    EXPECT_NEAR(motion_time(a, b, limits), duration, 1e-12);
    constexpr int kSteps = 60;
    const double h = duration / kSteps;
    if (h == 0.0) continue;
    double last_fraction = 0.0;
    for (int k = 0; k <= kSteps; ++k) {
      // Finite differences are means over an interval, so the limits bound them exactly.
      const double s = motion.fraction_at(k * h);
      const Configuration before = motion.at((k - 1) * h);
      const Configuration here = motion.at(k * h);
      const Configuration after = motion.at((k + 1) * h);
      EXPECT_GE(s, last_fraction);
      last_fraction = s;
      for (int i = 0; i < 6; ++i) {
        ASSERT_LE(std::abs(after[i] - here[i]) / h, limits.velocity[i] * (1.0 + 1e-6));
        ASSERT_LE(std::abs(after[i] - 2.0 * here[i] + before[i]) / (h * h),
                  limits.acceleration[i] * (1.0 + 1e-4) + 1e-9);
      }
    }
  }
}

TEST(StraightMotion, IsAsFastAsTheBestTrapezoid) {
  Rng random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const JointLimits limits = random_limits(random);
    const Configuration a = random_q(random);
    const Configuration b = random_q(random);
    double rate = 1e9;
    double acceleration = 1e9;
    for (int i = 0; i < 6; ++i) {
      const double delta = std::abs(a[i] - b[i]);
      if (delta == 0.0) continue;
      rate = std::min(rate, limits.velocity[i] / delta);
      acceleration = std::min(acceleration, limits.acceleration[i] / delta);
    }
    const double best = brute_force_time(rate, acceleration);
    const double ours = motion_time(a, b, limits);
    EXPECT_LE(ours, best * (1.0 + 1e-9));
    EXPECT_GE(ours, best * 0.99);
  }
}

TEST(StraightMotion, TakesNoTimeToStay) {
  Rng random(3);
  const Configuration q = random_q(random);
  const StraightMotion motion(q, q, random_limits(random));
  EXPECT_EQ(motion.duration_s(), 0.0);
  EXPECT_EQ(motion.at(0.0), q);
}

TEST(AxisMotionTime, CruisesOnlyWhenTheWayIsLongEnough) {
  EXPECT_DOUBLE_EQ(axis_motion_time(-1.0, 1.0, 0.5), 2.0 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(axis_motion_time(3.0, 1.0, 0.5), 3.0 + 2.0);
  EXPECT_DOUBLE_EQ(axis_motion_time(0.0, 1.0, 0.5), 0.0);
}

}  // namespace
}  // namespace canopeer
