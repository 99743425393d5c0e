#include "canopeer/robot/endless_joints.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "canopeer/base/rng.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {
namespace {

constexpr double kPi = std::numbers::pi;

/// Of six joints, those of an odd number turn without end.
EndlessJoints every_other() {
  JointLimits limits;
  limits.lower = Configuration::Constant(6, -20.0);
  limits.upper = Configuration::Constant(6, 20.0);
  for (const int i : {1, 3, 5}) {
    limits.lower[i] = -std::numeric_limits<double>::infinity();
    limits.upper[i] = std::numeric_limits<double>::infinity();
  }
  return EndlessJoints(limits);
}

Configuration random_q(Rng& random) {
  Configuration q(6);
  for (double& joint : q) joint = random.uniform(-20.0, 20.0);
  return q;
}

TEST(EndlessJoints, NearestIsTheSamePlaceWithinHalfATurn) {
  const EndlessJoints endless = every_other();
  Rng random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Configuration a = random_q(random);
    const Configuration b = random_q(random);
    const Configuration near = endless.nearest(b, a);
    for (int i = 0; i < 6; ++i) {
      const double turns = (near[i] - b[i]) / (2.0 * kPi);
      EXPECT_NEAR(turns, std::round(turns), 1e-12);
      if (endless[i]) {
        EXPECT_LE(std::abs(near[i] - a[i]), kPi + 1e-9);
      } else {
        EXPECT_EQ(near[i], b[i]);
      }
    }
    EXPECT_NEAR(endless.distance(near, b), 0.0, 1e-12);
    EXPECT_NEAR(endless.distance(a, b), joint_distance(a, near), 1e-9);
    EXPECT_NEAR(endless.distance(a, b), endless.distance(b, a), 1e-9);
    EXPECT_EQ(endless.distance(a.data(), b), endless.distance(a, b));
  }
}

TEST(EndlessJoints, AMotionFromWholeTurnsAwayIsTheSameMotion) {
  const EndlessJoints endless = every_other();
  Rng random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const Configuration a = random_q(random);
    Configuration b = random_q(random);
    // Half a turn, where rounding alone decides which way round is the shorter.
    if (trial % 2 == 0) b[3] = a[3] + kPi;
    Configuration start = a;
    for (const int i : {1, 3, 5})
      start[i] += 2.0 * kPi * (static_cast<double>(random.index(9)) - 4);
    const Configuration moved = endless.goal(start, a, b) - start;
    EXPECT_LT((moved - (endless.nearest(b, a) - a)).lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

TEST(EndlessJoints, AHalfTurnGoesTheSameWayForwardsAndBack) {
  const EndlessJoints endless = every_other();
  const Configuration a = Configuration::Constant(6, 0.1);
  const Configuration b = Configuration::Constant(6, 0.1 + kPi);
  const Configuration there = endless.nearest(b, a) - a;
  const Configuration back = endless.nearest(a, b) - b;
  EXPECT_LT((there + back).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(EndlessJoints, WithoutAnyAllIsAsItWas) {
  const EndlessJoints none;
  EXPECT_FALSE(none.any());
  const Configuration a = Configuration::Constant(6, 4.0);
  const Configuration b = Configuration::Constant(6, -4.0);
  EXPECT_EQ(none.nearest(b, a), b);
  EXPECT_EQ(none.goal(a, a, b), b);
  EXPECT_EQ(none.distance(a, b), joint_distance(a, b));
}

}  // namespace
}  // namespace canopeer
