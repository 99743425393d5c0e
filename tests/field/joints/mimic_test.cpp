// Joints that follow others: grippers outside the arm, telescopes in it, rods beside it.

#include <kdl/chainfksolverpos_recursive.hpp>

#include "../../robot/kdl_chain.h"
#include "canopeer/base/rng.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/view_ik.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::joint_line;
using test::pose_of;
using test::SmallArm;

std::string mimic(const std::string& joint, const std::string& more = "") {
  return "<mimic joint='" + joint + "' " + more + "/>";
}

/// Two fingers at the tool, the second as the first; `more` goes into the first.
SmallArm with_gripper(const std::string& yaml = "") {
  const std::string limit = "<limit lower='0' upper='0.04' velocity='0.1' effort='1'/>";
  SmallArm arm;
  arm.add(
      "<link name='f1'/>\n<link name='f2'/>\n<link name='f3'/>\n" +
          joint_line("g1", "prismatic", "tool", "f1", "0.05 0 0", "0 1 0", limit) +
          joint_line("g2", "prismatic", "tool", "f2", "0.05 0 0", "0 -1 0", limit + mimic("g1")) +
          joint_line("g3", "revolute", "f2", "f3", "0 0 0", "0 0 1",
                     "<limit lower='-1' upper='1' velocity='1' effort='1'/>" +
                         mimic("g2", "multiplier='-10' offset='0.1'")),
      yaml);
  return arm;
}

TEST(FieldMimic, AGripperStandsStillWithAllThatFollowsIt) {
  SmallArm closed = with_gripper();
  EXPECT_EQ(closed.notices(), "");
  const Configuration home = closed.model().home("side_1");
  const auto in_tool = [&](const RobotModel& robot, const char* link) -> Pose {
    return pose_of(robot, "tool", home).inverse() * pose_of(robot, link, home);
  };
  const RobotModel open = with_gripper("standing_joints_rad: {g1: 0.03}\n").model();
  EXPECT_TRUE(in_tool(closed.model(), "f1").isApprox(Pose(Eigen::Translation3d(0.05, 0, 0)), 1e-9));
  EXPECT_TRUE(in_tool(open, "f1").isApprox(Pose(Eigen::Translation3d(0.05, 0.03, 0)), 1e-9));
  EXPECT_TRUE(in_tool(open, "f2").isApprox(Pose(Eigen::Translation3d(0.05, -0.03, 0)), 1e-9));
  // −10 · 0.03 + 0.1
  const Pose f3 = in_tool(open, "f3");
  EXPECT_TRUE(
      f3.linear().isApprox(Eigen::AngleAxisd(-0.2, Vec3::UnitZ()).toRotationMatrix(), 1e-9));
}

TEST(FieldMimic, AFollowerThatWouldLeaveItsLimitsIsHeldAndSaid) {
  SmallArm arm = with_gripper("standing_joints_rad: {g1: 0.04}\n");
  arm.replace("lower='-1' upper='1' velocity='1' effort='1'",
              "lower='-0.1' upper='1' velocity='1'");
  EXPECT_EQ(
      arm.notices(),
      "small.urdf:22: joint 'g3' follows 'g1' to -0.30000000000000004, outside its limits -0.1 "
      "... 1: it stands at -0.1");
}

TEST(FieldMimic, LimitsOfAFollowerThatAreOneAreNone) {
  SmallArm arm = with_gripper("standing_joints_rad: {g1: 0.04}\n");
  arm.replace("lower='-1' upper='1' velocity='1' effort='1'", "lower='0' upper='0' velocity='0'");
  EXPECT_EQ(arm.notices(), "");
  const RobotModel robot = arm.model();
  const Configuration home = robot.home("side_1");
  EXPECT_TRUE((pose_of(robot, "f2", home).inverse() * pose_of(robot, "f3", home))
                  .linear()
                  .isApprox(Eigen::AngleAxisd(-0.3, Vec3::UnitZ()).toRotationMatrix(), 1e-9));
}

TEST(FieldMimic, AFloatingJointCannotFollow) {
  SmallArm arm;
  arm.add("<link name='f'/>\n" +
          joint_line("ball", "floating", "tool", "f", "0 0 0", "0 0 1", mimic("j1")));
  EXPECT_EQ(
      arm.error(),
      "robot.yaml: small.urdf:18: joint 'ball' mimics 'j1', but only revolute, continuous and "
      "prismatic joints can");
}

TEST(FieldMimic, AllThatIsWrongIsNamedAtOnce) {
  const std::string limit = "<limit lower='-1' upper='1' velocity='1'/>";
  SmallArm arm;
  arm.replace("<axis xyz='0 1 0'/><limit", "<axis xyz='0 1 0'/>" + mimic("j1") + "<limit");  // j2
  arm.add("<link name='a'/>\n<link name='b'/>\n<link name='c'/>\n<link name='d'/>\n" +
          joint_line("ja", "revolute", "tool", "a", "0 0 0", "0 0 1", limit + mimic("nobody")) +
          joint_line("jb", "revolute", "tool", "b", "0 0 0", "0 0 1", limit + mimic("jb")) +
          joint_line("jc", "revolute", "tool", "c", "0 0 0", "0 0 1", limit + mimic("jd")) +
          joint_line("jd", "revolute", "tool", "d", "0 0 0", "0 0 1", limit + mimic("jc")));
  EXPECT_EQ(
      arm.error(),
      "robot.yaml: small.urdf:11: joint 'j2' mimics 'j1': leave it out of arm_joints, it "
      "follows by itself; small.urdf:21: joint 'ja' mimics 'nobody', but there is no joint of "
      "that name; small.urdf:22: joint 'jb' mimics itself; small.urdf:23: joint 'jc' mimics "
      "'jd' in a circle; small.urdf:24: joint 'jd' mimics 'jc' in a circle");
}

TEST(FieldMimic, OneThatNamesNoJointOrNoNumberIsRefusedWithItsLine) {
  SmallArm arm = with_gripper();
  EXPECT_EQ(SmallArm(arm).replace("<mimic joint='g1' />", "<mimic/>").error(),
            "small.urdf:21: joint 'g2': its <mimic> names no joint: <mimic joint=\"...\"/>");
  EXPECT_EQ(SmallArm(arm).replace("multiplier='-10'", "multiplier='ten'").error(),
            "small.urdf:22: joint 'g3': <mimic multiplier=\"ten\">: expected a number");
}

/// j3 slides, and a second stage slides half as far again with it before the forearm.
SmallArm telescope() {
  SmallArm arm;
  arm.replace("name='j3' type='revolute'", "name='j3' type='prismatic'");
  arm.replace("<parent link='upper'/><child link='fore'/>",
              "<parent link='upper'/><child link='stage'/>");
  arm.add("<link name='stage'/>\n" +
          joint_line("j3b", "prismatic", "stage", "fore", "0 0.01 0", "0 0.6 0.8",
                     "<limit lower='-0.3' upper='0.4' velocity='0.25'/>" +
                         mimic("j3", "multiplier='0.5' offset='0.05'")));
  arm.replace("0.6, 1.2, 0.0", "0.6, 0.2, 0.0");
  return arm;
}

TEST(FieldMimic, InTheArmItHasTheKinematicsThatKdlGivesIt) {
  const RobotModel robot = telescope().model();
  EXPECT_EQ(robot.dof(), 6);
  std::vector<std::string> names;
  const KDL::Chain chain = kdl_chain(robot.description(), "base", "camera", &names);
  ASSERT_EQ(names, (std::vector<std::string>{"j1", "j2", "j3", "j3b", "j4", "j5", "j6"}));
  KDL::ChainFkSolverPos_recursive kdl(chain);
  Rng random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Configuration q(6);
    for (int i = 0; i < 6; ++i) q[i] = random.uniform(robot.span().lower[i], robot.span().upper[i]);
    Configuration all(7);
    all << q[0], q[1], q[2], 0.5 * q[2] + 0.05, q[3], q[4], q[5];
    KDL::Frame frame;
    ASSERT_GE(kdl.JntToCart(kdl_joints(all), frame), 0);
    const Pose T = robot.T_base_camera(q);
    ASSERT_LT((T.matrix() - canopeer::pose_of(frame).matrix()).cwiseAbs().maxCoeff(), 1e-12);
    ASSERT_TRUE(pose_of(robot, "camera", q).isApprox(T, 1e-12));
    Pose same;
    RobotModel::Jacobian jacobian;
    robot.camera_jacobian(q, same, jacobian);
    for (int i = 0; i < 6; ++i) {
      Configuration ahead = q;
      ahead[i] += 1e-6;
      const Vec3 moved = (robot.T_base_camera(ahead).translation() - T.translation()) / 1e-6;
      ASSERT_LT((moved - jacobian.col(i).head<3>()).norm(), 1e-5) << i;
    }
  }
}

TEST(FieldMimic, InTheArmItsLimitsBindTheOneItFollows) {
  SmallArm arm = telescope();
  const RobotModel robot = arm.model();
  EXPECT_DOUBLE_EQ(robot.limits().lower[2], (-0.3 - 0.05) / 0.5);
  EXPECT_DOUBLE_EQ(robot.limits().upper[2], (0.4 - 0.05) / 0.5);
  EXPECT_DOUBLE_EQ(robot.limits().velocity[2], 0.5);
  EXPECT_EQ(arm.notices(),
            "small.urdf:12: joint 'j3' moves from -0.7 to 0.7000000000000001 only: beyond that "
            "'j3b', which follows it, is outside its limits");
}

TEST(FieldMimic, InTheArmViewsAreReached) {
  const RobotModel robot = telescope().model();
  const auto ik = ArmIk::make(robot);
  ASSERT_TRUE(ik) << ik.error().message;
  EXPECT_EQ(ik->kind(), IkKind::kNumeric);
  Rng random(2);
  std::vector<Configuration> found;
  int reached = 0;
  for (int trial = 0; trial < 50; ++trial) {
    Configuration q(6);
    for (int i = 0; i < 6; ++i) q[i] = random.uniform(robot.span().lower[i], robot.span().upper[i]);
    const Pose T = robot.T_base_camera(q);
    ik->solve_view(T.translation(), T * Vec3(0, 0, 0.4), robot.home("side_1"), found);
    reached += found.empty() ? 0 : 1;
    for (const Configuration& other : found) {
      const Pose there = robot.T_base_camera(other);
      EXPECT_LT((there.translation() - T.translation()).norm(), 1e-6);
      EXPECT_LT((there.linear().col(2) - T.linear().col(2)).norm(), 1e-6);
    }
  }
  EXPECT_GE(reached, 45);
}

/// A rod on the base that swings with the second joint, the other way and twice as far, beside the
/// arm's plane; and a knob on the forearm that reaches over to it.
RobotModel arm_with_rod() {
  SmallArm arm;
  arm.add(
      "<link name='rod'><collision><origin xyz='0 0 0.3'/><geometry><box size='0.03 0.03 0.6'/>"
      "</geometry></collision></link>\n" +
      joint_line("swing", "continuous", "base", "rod", "0.15 0.12 0.2", "0 1 0",
                 mimic("j2", "multiplier='-2' offset='0.3'")));
  arm.replace("<link name='fore'>",
              "<link name='fore'><collision><origin xyz='0.2 0.1 0'/><geometry><box size='0.03 0.2 "
              "0.03'/></geometry></collision>");
  return arm.model();
}

TEST(FieldMimic, BesideTheArmItMovesWithTheJointItFollows) {
  const RobotModel robot = arm_with_rod();
  EXPECT_FALSE(robot.endless().any());
  Configuration q = Configuration::Zero(6);
  q[1] = 0.4;
  EXPECT_TRUE(pose_of(robot, "rod", q)
                  .linear()
                  .isApprox(Eigen::AngleAxisd(0.3 - 0.8, Vec3::UnitY()).toRotationMatrix(), 1e-12));
  EXPECT_TRUE(pose_of(robot, "rod", q).translation().isApprox(Vec3(0.15, 0.12, 0.2), 1e-12));
}

TEST(FieldMimic, WhatTheCheckerCallsFreeIsFreeOfLinksThatFollow) {
  const RobotModel robot = arm_with_rod();
  const CollisionChecker checker(robot, {});
  const ExactChecker exact(robot);
  const int rod = robot.link_index("rod");
  Rng random(3);
  int free = 0;
  int touching = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Configuration a(6);
    Configuration b(6);
    for (int i = 0; i < 6; ++i) {
      a[i] = random.uniform(-2.0, 2.0);
      b[i] = std::clamp(a[i] + random.uniform(-1.0, 1.0), -2.5, 2.5);
    }
    const bool called_free = checker.edge_free(a, b);
    free += called_free ? 1 : 0;
    bool met_rod = false;
    for (int k = 0; k <= 100; ++k) {
      const Configuration q = a + k / 100.0 * (b - a);
      for (const auto& pair : exact.touching_pairs(q, {})) {
        if (pair.first == rod || pair.second == rod) met_rod = true;
      }
    }
    touching += met_rod ? 1 : 0;
    EXPECT_FALSE(called_free && met_rod) << a.transpose() << " to " << b.transpose();
  }
  EXPECT_GT(free, 10);
  EXPECT_GT(touching, 10);
}

TEST(FieldMimic, AJointThatTurnsWithoutEndMustTurnWhatFollowsItWhole) {
  const auto with = [](const std::string& multiplier) {
    SmallArm arm;
    arm.replace("name='j1' type='revolute'", "name='j1' type='continuous'");
    arm.replace("<axis xyz='0 0 1'/><limit lower='-2.5' upper='2.5'", "<axis xyz='0 0 1'/><limit");
    arm.add("<link name='dial'/>\n" + joint_line("dial", "continuous", "base", "dial", "0 0 0",
                                                 "0 0 1",
                                                 mimic("j1", "multiplier='" + multiplier + "'")));
    return arm;
  };
  EXPECT_TRUE(with("-2").model().endless()[0]);
  EXPECT_EQ(
      with("0.5").error(),
      "robot.yaml: small.urdf:10: joint 'j1' turns without end, but 'dial' follows it by 0.5: "
      "one of them needs limits");
}

TEST(FieldMimic, ASecondStageOfALiftRisesWithIt) {
  SmallArm arm;
  arm.replace("<link name='base'/>",
              "<link name='foot'/>\n<link name='mast'/>\n<link name='base'/>");
  arm.replace("arm_joints:", "lift_joint: lift\narm_joints:");
  arm.add(joint_line("lift", "prismatic", "foot", "mast", "0 0 0.5", "0 0 1",
                     "<limit lower='0' upper='1' velocity='0.5'/>") +
          joint_line("lift2", "prismatic", "mast", "base", "0 0 0.1", "0 0 1",
                     "<limit lower='0' upper='0.8' velocity='0.5'/>" + mimic("lift")));
  const RobotModel robot = arm.model();
  EXPECT_DOUBLE_EQ(robot.lift_axis().upper, 0.8);
  EXPECT_NEAR(robot.T_world_base({0.0, 0.7}).translation().z(), 0.6 + 2.0 * 0.7, 1e-12);
}

}  // namespace
}  // namespace canopeer
