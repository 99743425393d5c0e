#include "canopeer/sensing/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace canopeer {
namespace {

std::string message(const std::string& text) {
  const auto trajectory = Trajectory::parse(text, "poses.txt");
  return trajectory.has_value() ? "no error" : trajectory.error().message;
}

TEST(Trajectory, PosesLieBetweenTheirNeighbours) {
  // Half a turn about z while going 2 m along x.
  const auto trajectory = Trajectory::parse(
      "# timestamp tx ty tz qx qy qz qw\n10 0 0 0 0 0 0 1\n\n12, 2, 0, 0, 0, 0, 1, 0\n", "t");
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  ASSERT_EQ(trajectory->poses().size(), 2U);
  const auto middle = trajectory->at(11.0, 5.0);
  ASSERT_TRUE(middle);
  EXPECT_TRUE(middle->translation().isApprox(Vec3(1, 0, 0)));
  const double angle = Eigen::AngleAxisd(middle->linear()).angle();
  EXPECT_NEAR(angle, std::numbers::pi / 2, 1e-12);
  EXPECT_TRUE(trajectory->at(10.0, 5.0)->isApprox(Pose::Identity()));
  EXPECT_TRUE(trajectory->at(12.0, 0.0)->translation().isApprox(Vec3(2, 0, 0)));
}

TEST(Trajectory, ThereIsNoPoseOutsideAndInGaps) {
  const auto trajectory = Trajectory::parse("10 0 0 0 0 0 0 1\n12 2 0 0 0 0 0 1\n", "t");
  ASSERT_TRUE(trajectory);
  EXPECT_FALSE(trajectory->at(9.999, 5.0));
  EXPECT_FALSE(trajectory->at(12.001, 5.0));
  EXPECT_FALSE(trajectory->at(11.0, 1.9));
  EXPECT_TRUE(trajectory->at(11.0, 2.0));
}

TEST(Trajectory, InterpolationTakesTheShortWayRound) {
  // The same rotation, once as q and once as −q.
  const auto trajectory = Trajectory::parse("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 -1\n", "t");
  EXPECT_TRUE(trajectory->at(0.5, 2.0)->isApprox(Pose::Identity()));
}

TEST(Trajectory, ErrorsNameTheLine) {
  EXPECT_NE(message("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n").find("poses.txt:2: expected the 8 numbers"),
            std::string::npos);
  EXPECT_NE(message("0 0 0 zero 0 0 0 1\n").find("poses.txt:1"), std::string::npos);
  EXPECT_NE(message("0 0 0 zero 0 0 0 1\n").find("zero"), std::string::npos);
  EXPECT_NE(message("0 0 nan 0 0 0 0 1\n").find("nan"), std::string::npos);
  EXPECT_NE(message("0 0 0 0 0 0 0 0\n").find("quaternion"), std::string::npos);
  EXPECT_NE(message("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n").find("poses.txt:2: the time stamp"),
            std::string::npos);
  EXPECT_NE(message("# nothing\n").find("no pose"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
