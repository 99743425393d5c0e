// Continuous joints as they stand in people's files.

#include <numbers>

#include "small_arm.h"

namespace canopeer {
namespace {

using test::SmallArm;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// j6 continuous, with this in it.
SmallArm with_j6(const std::string& limit, const std::string& type = "continuous") {
  SmallArm arm;
  const auto at = arm.urdf.find("<joint name='j6'");
  const auto end = arm.urdf.find('\n', at);
  arm.urdf.replace(at, end + 1 - at,
                   test::joint_line("j6", type, "bend", "tool", "0.08 0 0", "1 0 0", limit));
  return arm;
}

TEST(FieldContinuous, WithoutARangeItTurnsWithoutEnd) {
  for (const char* limit :
       {"<limit velocity='1.5' effort='9'/>", "<limit lower='0' upper='0' velocity='1.5'/>",
        "<limit lower='-inf' upper='inf' velocity='1.5'/>",
        "<limit lower='-Infinity' upper='Infinity' velocity='1.5'/>",
        "<limit lower='-1e16' upper='1e16' velocity='1.5'/>",
        "<limit lower='-1e999' upper='1e999' velocity='1.5'/>"}) {
    const RobotModel robot = with_j6(limit).model();
    EXPECT_TRUE(robot.endless()[5]) << limit;
    EXPECT_FALSE(robot.endless()[0]);
    EXPECT_EQ(robot.limits().velocity[5], 1.5);
    EXPECT_EQ(robot.span().upper[5], std::numbers::pi);
    Configuration q = robot.home("side_1");
    const Pose T = robot.T_base_camera(q);
    q[5] += 40.0 * kTurn;
    EXPECT_TRUE(robot.within_limits(q));
    EXPECT_TRUE(robot.T_base_camera(q).isApprox(T, 1e-12));
  }
}

TEST(FieldContinuous, ARangeBesideItCounts) {
  const RobotModel robot =
      with_j6("<limit lower='-6.2832' upper='6.2832' velocity='1.5' effort='9'/>").model();
  EXPECT_FALSE(robot.endless().any());
  EXPECT_EQ(robot.limits().lower[5], -6.2832);
  EXPECT_EQ(robot.limits().upper[5], 6.2832);
}

TEST(FieldContinuous, HalfARangeIsRefused) {
  EXPECT_EQ(with_j6("<limit lower='-3' velocity='1.5'/>").error(),
            "robot.yaml: small.urdf:15: joint 'j6' cannot be moved: its <limit> has a lower limit "
            "but no upper");
}

TEST(FieldContinuous, WithoutAVelocityItIsRefused) {
  for (const char* limit : {"", "<limit effort='9'/>", "<limit velocity='0'/>"}) {
    EXPECT_EQ(
        with_j6(limit).error(),
        "robot.yaml: small.urdf:15: joint 'j6' needs finite limits; missing: velocity above 0 (or "
        "arm_velocity_limits_rad_s in the robot file)");
  }
}

TEST(FieldContinuous, ARevoluteJointWithFarLimitsTurnsWithoutEndAndThatIsSaid) {
  const SmallArm arm = with_j6("<limit lower='-1e16' upper='1e16' velocity='1'/>", "revolute");
  EXPECT_TRUE(arm.model().endless()[5]);
  EXPECT_EQ(
      arm.notices(),
      "small.urdf:15: joint 'j6': its limits -1e+16 ... 1e+16 are none: it turns without end");
}

TEST(FieldContinuous, OutsideTheArmItStandsStill) {
  SmallArm arm;
  arm.add("<link name='wheel'/>\n" +
          test::joint_line("roll", "continuous", "base", "wheel", "0 0 0.1", "0 1 0"));
  EXPECT_EQ(arm.notices(), "");
  EXPECT_TRUE(test::pose_of(arm.model(), "wheel", arm.model().home("side_1"))
                  .isApprox(Pose(Eigen::Translation3d(0, 0, 0.1)), 1e-12));
}

TEST(FieldContinuous, AHomeMayBeAnyNumberOfTurnsAway) {
  SmallArm arm = with_j6("<limit velocity='1.5'/>");
  arm.replace("0.3, 0.0]}", "0.3, 12.566370614359172]}");
  EXPECT_EQ(arm.error(), "accepted");
  arm.replace("12.566370614359172]}", "1e5]}");
  EXPECT_NE(arm.error().find("joint 'j6' at 1e+05 is outside its limits"), std::string::npos)
      << arm.error();
}

}  // namespace
}  // namespace canopeer
