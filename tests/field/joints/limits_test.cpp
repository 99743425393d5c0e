// Limits as they stand in people's files: missing, turned round, in degrees, a digit too short.

#include <numbers>

#include "small_arm.h"

namespace canopeer {
namespace {

using test::SmallArm;

const std::string kJ6Limit =
    "<axis xyz='1 0 0'/><limit lower='-2.5' upper='2.5' velocity='1.5' "
    "effort='9'/></joint>\n<joint "
    "name='mount'";

/// With another <limit> at j6.
SmallArm with_limit(const std::string& limit) {
  return SmallArm().replace(kJ6Limit,
                            "<axis xyz='1 0 0'/>" + limit + "</joint>\n<joint name='mount'");
}

TEST(FieldLimits, AHomeSevenDigitsShortOfALimitIsAtTheLimit) {
  SmallArm arm = with_limit(
      "<limit lower='-3.141592653589793' upper='3.141592653589793' "
      "velocity='1.5' effort='9'/>");
  arm.replace("0.3, 0.0]}", "0.3, 3.1415927]}");
  EXPECT_EQ(arm.model().home("side_1")[5], std::numbers::pi);
  arm.replace("3.1415927]}", "3.1415937]}");
  EXPECT_EQ(arm.error(),
            "robot.yaml: home state 'side_1': joint 'j6' at 3.1415937 is outside its limits "
            "-3.141592653589793 ... 3.141592653589793");
}

TEST(FieldLimits, AStateWithinTheToleranceIsWithin) {
  const RobotModel robot = SmallArm().model();
  Configuration q = Configuration::Zero(6);
  q[2] = 2.5 + 9e-7;
  EXPECT_TRUE(robot.within_limits(q));
  q[2] = -2.5 - 2e-6;
  EXPECT_FALSE(robot.within_limits(q));
}

TEST(FieldLimits, EveryHomeOutsideItsLimitsIsNamed) {
  SmallArm arm;
  arm.replace("[1.5, -0.6, 1.2, 0.0, 0.3, 0.0]", "[3.0, -0.6, 1.2, 0.0, 0.3, -2.6]");
  EXPECT_EQ(arm.error(),
            "robot.yaml: home state 'side_1': joint 'j1' at 3 is outside its limits -2.5 ... 2.5; "
            "home state 'side_1': joint 'j6' at -2.6 is outside its limits -2.5 ... 2.5");
}

TEST(FieldLimits, EveryJointWithoutALimitIsNamedWithItsLine) {
  SmallArm arm = with_limit("");
  arm.replace("<axis xyz='0 0 1'/><limit lower='-2.5' upper='2.5' velocity='1.5' effort='9'/>",
              "<axis xyz='0 0 1'/>");
  EXPECT_EQ(arm.error(),
            "small.urdf:10: joint 'j1': revolute joints need <limit lower=\"...\" upper=\"...\" "
            "velocity=\"...\"/>; small.urdf:15: joint 'j6': revolute joints need <limit "
            "lower=\"...\" upper=\"...\" velocity=\"...\"/>");
}

TEST(FieldLimits, WhatIsWrongWithALimitIsSaidWithItsLine) {
  const std::string at = "robot.yaml: small.urdf:15: joint 'j6'";
  EXPECT_EQ(with_limit("<limit lower='1' upper='-1' velocity='1'/>").error(),
            at + ": expected lower <= upper, both within 1e4, found 1 and -1");
  EXPECT_EQ(with_limit("<limit lower='-1' upper='1' velocity='0'/>").error(),
            at + " needs finite limits; missing: velocity above 0 (or "
                 "arm_velocity_limits_rad_s in the robot file)");
  EXPECT_EQ(with_limit("<limit lower='-1' upper='1' effort='3'/>").error(),
            at + " needs finite limits; missing: velocity above 0 (or "
                 "arm_velocity_limits_rad_s in the robot file)");
  EXPECT_EQ(with_limit("<limit velocity='1' effort='3'/>").error(),
            at + " cannot be moved: its <limit> has neither lower nor upper");
  EXPECT_EQ(with_limit("<limit upper='1' velocity='1'/>").error(),
            at + " cannot be moved: its <limit> has an upper limit but no lower");
  EXPECT_EQ(with_limit("<limit lower='nan' upper='1' velocity='1'/>").error(),
            "small.urdf:15: joint 'j6': <limit lower=\"nan\">: expected a number");
  EXPECT_EQ(with_limit("<limit lower='-1,5' upper='1' velocity='1'/>").error(),
            "small.urdf:15: joint 'j6': <limit lower=\"-1,5\">: expected a number");
  EXPECT_EQ(with_limit("<limit lower='0' upper='1e9' velocity='1'/>").error(),
            at + ": expected lower <= upper, both within 1e4, found 0 and 1e+09");
}

TEST(FieldLimits, TheRobotFileMaySayTheVelocities) {
  SmallArm arm = with_limit("<limit lower='-1' upper='1' velocity='0'/>");
  arm.add("", "arm_velocity_limits_rad_s: [1, 1, 1, 1, 1, 0.5]\n");
  EXPECT_EQ(arm.model().limits().velocity[0], 1.0);
  EXPECT_EQ(arm.model().limits().velocity[5], 0.5);
}

TEST(FieldLimits, AShapeOfNoSizeIsLeftOutAndSaid) {
  SmallArm arm;
  arm.replace("<box size='0.06 0.06 0.06'/>", "<box size='0 0 0'/>");
  EXPECT_EQ(arm.notices(), "small.urdf:3: link 'waist': a <box> of no size is left out");
  arm.replace("<box size='0 0 0'/>", "<box size='0 0 -1'/>");
  EXPECT_EQ(arm.error(),
            "small.urdf:3: link 'waist': <box> needs three numbers in size, none below 0");
}

TEST(FieldLimits, AnEffortIsNotAskedFor) {
  EXPECT_EQ(with_limit("<limit lower=' -1 ' upper='+1' velocity='1'/>").model().limits().upper[5],
            1.0);
}

TEST(FieldLimits, DegreesAndAJointThatCannotMoveAreNoticed) {
  EXPECT_EQ(with_limit("<limit lower='-180' upper='180' velocity='1'/>").notices(),
            "small.urdf:15: joint 'j6': its limits -180 ... 180 rad are more than three turns; are "
            "they degrees?");
  EXPECT_EQ(with_limit("<limit lower='0' upper='0' velocity='1'/>").notices(),
            "small.urdf:15: joint 'j6' cannot move: both its limits are 0");
  EXPECT_EQ(with_limit("<limit lower='-6.2832' upper='6.2832' velocity='1'/>").notices(), "");
}

TEST(FieldLimits, SoftLimitsAreNotUsedAndSaid) {
  EXPECT_EQ(
      with_limit("<limit lower='-1' upper='1' velocity='1'/><safety_controller "
                 "soft_lower_limit='-0.9' soft_upper_limit='0.9' k_velocity='1'/>")
          .notices(),
      "small.urdf:15: joint 'j6': the soft limits of its <safety_controller>, -0.9 ... 0.9, are "
      "not used; if its controller keeps to them, write them into <limit>");
}

TEST(FieldLimits, APrismaticJointNeedsEnds) {
  SmallArm arm = with_limit("<limit lower='-inf' upper='inf' velocity='1'/>");
  arm.replace("'j6' type='revolute'", "'j6' type='prismatic'");
  EXPECT_EQ(arm.error(),
            "robot.yaml: small.urdf:15: joint 'j6' needs finite limits; missing: lower and upper");
}

TEST(FieldLimits, APrismaticJointAndAFixedOneInTheMiddleOfTheArmMoveIt) {
  SmallArm arm;
  arm.replace("name='j4' type='revolute'", "name='j4' type='prismatic'");
  arm.replace("<child link='bend'/>", "<child link='spacer'/>");
  arm.replace("name='j5' type='revolute'", "name='j5' type='fixed'");
  arm.replace(", j5, j6]", ", j5b, j6]");
  arm.add("<link name='spacer'/>\n" +
          test::joint_line("j5b", "revolute", "spacer", "bend", "0.01 0 0", "0 1 0",
                           "<limit lower='-1' upper='1' velocity='1'/>"));
  const RobotModel robot = arm.model();
  Configuration q = Configuration::Zero(6);
  q[3] = 0.2;
  EXPECT_EQ(robot.arm_joint_type(3), JointType::kPrismatic);
  EXPECT_TRUE(robot.T_base_camera(q).translation().isApprox(
      Vec3(0.35 + 0.2 + 0.08 + 0.01 + 0.08 + 0.06, 0.0, 0.7), 1e-12));
}

TEST(FieldLimits, ArmsOfNoJointAndOfTooManyAreRefusedInOneMessage) {
  EXPECT_EQ(SmallArm()
                .replace("[j1, j2, j3, j4, j5, j6]", "[]")
                .replace("[1.5, -0.6, 1.2, 0.0, 0.3, 0.0]", "[]")
                .error(),
            "robot.yaml: arm_joints: expected at least 1 and at most 10 joints, found 0");
  EXPECT_EQ(
      SmallArm().replace("[j1, j2, j3, j4, j5, j6]", "[a, b, c, d, e, f, g, h, i, j, k]").error(),
      "robot.yaml:4: arm_joints: expected at most 10 joints, found 11");
}

}  // namespace
}  // namespace canopeer
