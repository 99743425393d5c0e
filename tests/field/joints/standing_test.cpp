// Joints that nothing here moves: planar and floating ones above the arm, legs, heads.

#include "small_arm.h"

namespace canopeer {
namespace {

using test::joint_line;
using test::pose_of;
using test::SmallArm;

SmallArm with_base_joint(const std::string& type, const std::string& yaml = "") {
  SmallArm arm;
  arm.replace("<link name='base'/>", "<link name='ground'/>\n<link name='base'/>");
  arm.add(joint_line("drive", type, "ground", "base", "1 0 0.1", "0 0 2"), yaml);
  return arm;
}

SmallArm with_knee(const std::string& yaml = "") {
  SmallArm arm;
  arm.add("<link name='leg'/>\n" + joint_line("knee", "revolute", "base", "leg", "0.3 0 0", "0 1 0",
                                              "<limit lower='-2.6' upper='-0.6' velocity='1'/>"),
          yaml);
  return arm;
}

TEST(FieldStanding, PlanarAndFloatingJointsStandAtTheirOriginAndThatIsSaid) {
  for (const std::string type : {"planar", "floating"}) {
    const SmallArm arm = with_base_joint(type);
    EXPECT_EQ(arm.notices(), "small.urdf:18: joint 'drive' is " + type +
                                 ": it stands at its origin; say in standing_poses where else");
    EXPECT_TRUE(
        arm.model().T_world_base({}).isApprox(Pose(Eigen::Translation3d(1, 0, 0.1)), 1e-12));
  }
}

TEST(FieldStanding, TheRobotFileSaysWhereTheyStand) {
  const std::string yaml = "standing_poses:\n  drive: {xyz_m: [0.5, 2, 0], rpy_deg: [0, 0, 90]}\n";
  for (const std::string type : {"planar", "floating"}) {
    const SmallArm arm = with_base_joint(type, yaml);
    EXPECT_EQ(arm.notices(), "");
    const Pose T = arm.model().T_world_base({});
    EXPECT_TRUE(T.translation().isApprox(Vec3(1.5, 2, 0.1), 1e-12));
    EXPECT_TRUE(T.linear().col(0).isApprox(Vec3::UnitY(), 1e-12));
  }
}

TEST(FieldStanding, APlanarJointStaysInItsPlane) {
  const std::string wrong =
      "robot.yaml: small.urdf:18: joint 'drive' is planar: its standing pose must lie in the plane "
      "at right angles to its axis";
  EXPECT_EQ(with_base_joint("planar", "standing_poses: {drive: {xyz_m: [0, 0, 0.2]}}\n").error(),
            wrong);
  EXPECT_EQ(with_base_joint("planar", "standing_poses: {drive: {rpy_deg: [5, 0, 0]}}\n").error(),
            wrong);
  EXPECT_EQ(with_base_joint("floating", "standing_poses: {drive: {rpy_deg: [5, 0, 0]}}\n").error(),
            "accepted");
}

TEST(FieldStanding, BetweenBaseAndCameraTheyNeedAPose) {
  SmallArm arm;
  arm.replace("<child link='camera'/>", "<child link='gimbal'/>");
  arm.add("<link name='gimbal'/>\n" +
          joint_line("ball", "floating", "gimbal", "camera", "0 0 0", "1 0 0"));
  EXPECT_EQ(arm.error(),
            "robot.yaml: small.urdf:18: joint 'ball' is floating and lies between 'base' and "
            "'camera': nothing here moves it; say in standing_poses where it stands");
  arm.yaml += "standing_poses: {ball: {xyz_m: [0, 0, 0.01]}}\n";
  const Configuration zero = Configuration::Zero(6);
  const Vec3 camera = arm.model().T_base_camera(zero).translation();
  EXPECT_TRUE(camera.isApprox(SmallArm().model().T_base_camera(zero) * Vec3(0, 0, 0.01), 1e-12));
}

TEST(FieldStanding, AJointOutsideItsLimitsIsHeldAndSaid) {
  const SmallArm arm = with_knee();
  EXPECT_EQ(
      arm.notices(),
      "small.urdf:18: joint 'knee' is not moved here and would stand at 0, outside its limits "
      "-2.6 ... -0.6: it stands at -0.6");
  const RobotModel robot = arm.model();
  EXPECT_TRUE(pose_of(robot, "leg", robot.home("side_1"))
                  .linear()
                  .isApprox(Eigen::AngleAxisd(-0.6, Vec3::UnitY()).toRotationMatrix(), 1e-12));
}

TEST(FieldStanding, TheRobotFileSaysWhereItStands) {
  const SmallArm arm = with_knee("standing_joints_rad: {knee: -1.5}\n");
  EXPECT_EQ(arm.notices(), "");
  const RobotModel robot = arm.model();
  EXPECT_TRUE(pose_of(robot, "leg", robot.home("side_1"))
                  .linear()
                  .isApprox(Eigen::AngleAxisd(-1.5, Vec3::UnitY()).toRotationMatrix(), 1e-12));
  EXPECT_EQ(
      with_knee("standing_joints_rad: {knee: -0.5}\n").error(),
      "robot.yaml: small.urdf:18: joint 'knee': standing at -0.5 is outside its limits -2.6 ... "
      "-0.6");
}

TEST(FieldStanding, WhereTheFileGivesNoLimitsItStandsAnywhere) {
  SmallArm arm = with_knee("standing_joints_rad: {knee: -1.5}\n");
  arm.replace("<limit lower='-2.6' upper='-0.6' velocity='1'/>", "<limit velocity='1'/>");
  EXPECT_EQ(arm.notices(), "");
  const RobotModel robot = arm.model();
  EXPECT_TRUE(pose_of(robot, "leg", robot.home("side_1"))
                  .linear()
                  .isApprox(Eigen::AngleAxisd(-1.5, Vec3::UnitY()).toRotationMatrix(), 1e-12));
}

TEST(FieldStanding, AJointOfTheChainThatIsLeftOutIsSaid) {
  SmallArm arm;
  arm.replace("[j1, j2, j3, j4, j5, j6]", "[j1, j2, j3, j4, j5]");
  arm.replace("[1.5, -0.6, 1.2, 0.0, 0.3, 0.0]", "[1.5, -0.6, 1.2, 0.0, 0.3]");
  EXPECT_EQ(
      arm.notices(),
      "small.urdf:15: joint 'j6' lies between 'base' and 'camera' but is not in arm_joints: it "
      "stands at 0");
  arm.yaml += "standing_joints_rad: {j6: 0.5}\n";
  EXPECT_EQ(arm.notices(), "");
}

TEST(FieldStanding, WhatCannotStandSoIsNamedAtOnce) {
  SmallArm arm = with_knee(
      "standing_joints_rad: {j2: 0.1, mount: 0.2, drive: 1, nobody: 0}\n"
      "standing_poses: {knee: {xyz_m: [0, 0, 0]}}\n");
  arm.add("<link name='ball'/>\n" +
          joint_line("drive", "floating", "base", "ball", "0 0 0", "0 0 1"));
  EXPECT_EQ(arm.error(),
            "robot.yaml: standing_joints_rad: 'drive' has a whole pose: say it in standing_poses; "
            "standing_joints_rad: 'j2' is in arm_joints: it does not stand; standing_joints_rad: "
            "'mount' is fixed: its origin says where; standing_joints_rad: no joint is called "
            "'nobody'; standing_poses: 'knee' has one position: say it in standing_joints_rad");
}

TEST(FieldStanding, InTheArmAPlanarJointIsRefused) {
  SmallArm arm;
  arm.replace("name='j1' type='revolute'", "name='j1' type='planar'");
  EXPECT_EQ(arm.error(), "robot.yaml: joint 'j1' must be revolute or prismatic (arm joint)");
}

}  // namespace
}  // namespace canopeer
