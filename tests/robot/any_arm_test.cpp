// Arms of other builds than a UR: kinematics against KDL, inverse kinematics against forward.

#include <kdl/chainfksolverpos_recursive.hpp>
#include <numbers>

#include "canopeer/robot/kinematics/sin_cos.h"
#include "canopeer/robot/view_ik.h"
#include "kdl_chain.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr double kPi = std::numbers::pi;

/// A chain of joints from "base" to "camera", each about or along z of its frame but for `odd`.
struct ArmBuilder {
  RobotDescription robot;
  RobotSetup setup;

  ArmBuilder() { robot.links.push_back({"base", {}}); }
  void joint(const Pose& T_parent_joint, JointType type = JointType::kRevolute,
             const Vec3& axis = Vec3::UnitZ(), double reach = 3.0) {
    const std::string number = std::to_string(setup.arm_joints.size());
    Joint joint;
    joint.name = "joint" + number;
    joint.type = type;
    joint.parent = robot.links.back().name;
    joint.child = "link" + number;
    joint.T_parent_joint = T_parent_joint;
    joint.axis = axis;
    joint.lower = -reach;
    joint.upper = reach;
    joint.velocity_limit = joint.acceleration_limit = 2.0;
    robot.links.push_back({joint.child, {}});
    robot.joints.push_back(joint);
    setup.arm_joints.push_back(joint.name);
  }
  RobotModel camera(const Pose& T_flange_camera) {
    Joint mount;
    mount.name = "mount";
    mount.parent = robot.links.back().name;
    mount.child = "camera";
    mount.T_parent_joint = T_flange_camera;
    robot.links.push_back({"camera", {}});
    robot.joints.push_back(mount);
    setup.base_link = "base";
    setup.camera_frame = "camera";
    setup.home["side_1"] = Configuration::Zero(static_cast<int>(setup.arm_joints.size()));
    auto model = RobotModel::make(robot, setup);
    if (!model) ADD_FAILURE() << model.error().message;
    return *model;
  }
};

Pose placed(double x, double y, double z, double roll = 0.0, double pitch = 0.0, double yaw = 0.0) {
  Pose T = Pose::Identity();
  T.translate(Vec3(x, y, z));
  T.rotate(Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
           Eigen::AngleAxisd(roll, Vec3::UnitX()));
  return T;
}

/// As industrial arms are built: offsets at shoulder and elbow, axes 4, 5, 6 through one point.
RobotModel wrist_arm(bool rail, bool oblique_camera) {
  ArmBuilder arm;
  if (rail) arm.joint(Pose::Identity(), JointType::kPrismatic, Vec3::UnitX(), 0.7);
  arm.joint(placed(0, 0, 0.4));
  arm.joint(placed(0.15, 0.02, 0.1, -kPi / 2));
  arm.joint(placed(0.6, 0, 0), JointType::kRevolute, -Vec3::UnitZ());
  arm.joint(placed(0.1, -0.3, 0.03, kPi / 2), JointType::kRevolute);
  arm.joint(placed(0, 0, 0.35, -kPi / 2));
  arm.joint(placed(0, 0, 0, kPi / 2));
  return arm.camera(oblique_camera ? placed(0.03, 0.05, 0.1, 0.3, -0.4, 0.2) : placed(0, 0, 0.1));
}

/// Nothing in it is parallel, at right angles, or meets.
RobotModel crooked_arm(int joints) {
  ArmBuilder arm;
  for (int i = 0; i < joints; ++i)
    arm.joint(placed(0.1, 0.07 * i, 0.2, 0.4 + 0.8 * i, -0.3 * i, 0.5),
              i == 2 ? JointType::kPrismatic : JointType::kRevolute,
              Vec3(0.1 * i, -0.2, 1.0).normalized(), i == 2 ? 0.4 : 3.0);
  return arm.camera(placed(0.02, 0.01, 0.1, 0.2, 0.1, 0.0));
}

const RobotModel& rail_robot() {
  static const Expected<RobotModel> robot =
      load_robot(CANOPEER_SOURCE_DIR "/robots/panda_rail/robot.yaml");
  if (!robot) ADD_FAILURE() << robot.error().message;
  return *robot;
}

void expect_kinematics_of_kdl(const RobotModel& robot) {
  const RobotSetup& setup = robot.setup();
  std::vector<std::string> names;
  const KDL::Chain chain =
      kdl_chain(robot.description(), setup.base_link, setup.camera_frame, &names);
  ASSERT_EQ(names, setup.arm_joints);
  KDL::ChainFkSolverPos_recursive kdl(chain);
  Rng random(5);
  std::vector<Pose> all;
  for (int trial = 0; trial < 500; ++trial) {
    const Configuration q = random_configuration(random, robot);
    KDL::Frame frame;
    ASSERT_GE(kdl.JntToCart(kdl_joints(q), frame), 0);
    const Pose ours = robot.T_base_camera(q);
    ASSERT_LT((ours.matrix() - pose_of(frame).matrix()).cwiseAbs().maxCoeff(), 1e-12);
    robot.link_poses(q, {}, all);
    ASSERT_TRUE(
        all[robot.link_index(setup.camera_frame)].isApprox(robot.T_world_base({}) * ours, 1e-12));
    Pose T;
    RobotModel::Jacobian jacobian;
    robot.camera_jacobian(q, T, jacobian);
    constexpr double kStep = 1e-6;
    for (int i = 0; i < robot.dof(); ++i) {
      Configuration ahead = q;
      ahead[i] += kStep;
      const Pose moved = robot.T_base_camera(ahead);
      ASSERT_LT(
          ((moved.translation() - T.translation()) / kStep - jacobian.col(i).head<3>()).norm(),
          1e-5);
      const Eigen::AngleAxisd turn(moved.linear() * T.linear().transpose());
      ASSERT_LT((turn.angle() * turn.axis() / kStep - jacobian.col(i).tail<3>()).norm(), 1e-4);
    }
  }
}

/// Share of random poses of the arm that are solved; every solution must be right.
double solved_share(const RobotModel& robot, const ArmIk& ik, bool original_too) {
  Rng random(6);
  std::vector<Configuration> found;
  int solved = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Configuration q = random_configuration(random, robot);
    const Pose T = robot.T_base_camera(q);
    found.clear();
    ik.solve(T, q, found);
    double nearest = 1.0;
    for (const Configuration& candidate : found) {
      EXPECT_TRUE(robot.within_limits(candidate));
      EXPECT_TRUE(robot.T_base_camera(candidate).isApprox(T, 1e-6));
      nearest = std::min(nearest, (candidate - q).lpNorm<Eigen::Infinity>());
    }
    if (original_too) {
      EXPECT_LT(nearest, 1e-5) << q.transpose();
    }
    solved += found.empty() ? 0 : 1;
  }
  return static_cast<double>(solved) / kTrials;
}

void expect_views_look_at_their_targets(const RobotModel& robot, const ArmIk& ik) {
  Rng random(7);
  std::vector<Configuration> found;
  for (int trial = 0; trial < 200; ++trial) {
    const Pose T = robot.T_base_camera(random_configuration(random, robot));
    const Vec3 target = T * Vec3(0.0, 0.0, 0.5);
    const Configuration reference = random_configuration(random, robot);
    ik.solve_view(T.translation(), target, reference, found);
    double last = 0.0;
    for (const Configuration& q : found) {
      EXPECT_TRUE(robot.within_limits(q));
      const Pose reached = robot.T_base_camera(q);
      EXPECT_LT((reached.translation() - T.translation()).norm(), 1e-6);
      EXPECT_LT((reached.linear().col(2) - T.linear().col(2)).norm(), 1e-6);
      EXPECT_GE(joint_distance(q, reference), last);
      last = joint_distance(q, reference);
    }
  }
}

TEST(SinCos, AgreesWithTheLibraryToTheLastPlaces) {
  Rng random(1);
  for (int trial = 0; trial < 200000; ++trial) {
    alignas(32) double angles[4];
    alignas(32) double sines[4];
    alignas(32) double cosines[4];
    for (double& angle : angles)
      angle = trial % 2 == 0 ? random.uniform(-7.0, 7.0) : random.uniform(-1e5, 1e5);
    sin_cos(angles, 4, sines, cosines);
    for (int i = 0; i < 4; ++i) {
      ASSERT_NEAR(sines[i], std::sin(angles[i]), 2.3e-16) << angles[i];
      ASSERT_NEAR(cosines[i], std::cos(angles[i]), 2.3e-16) << angles[i];
    }
  }
}

TEST(AnyArm, HasTheKinematicsThatKdlGivesIt) {
  expect_kinematics_of_kdl(shipped_robot());
  expect_kinematics_of_kdl(rail_robot());
  expect_kinematics_of_kdl(wrist_arm(true, true));
  expect_kinematics_of_kdl(crooked_arm(7));
}

TEST(AnyArm, WithASphericalWristIsSolvedInClosedForm) {
  for (const bool oblique : {false, true}) {
    const RobotModel robot = wrist_arm(false, oblique);
    const auto ik = ArmIk::make(robot);
    ASSERT_TRUE(ik) << ik.error().message;
    EXPECT_EQ(ik->kind(), IkKind::kSphericalWrist);
    EXPECT_EQ(ik->sampled_joints(), 0);
    EXPECT_EQ(solved_share(robot, *ik, true), 1.0);
    expect_views_look_at_their_targets(robot, *ik);
  }
}

TEST(AnyArm, OnARailIsSolvedInClosedFormWithTheRailSampled) {
  const RobotModel robot = wrist_arm(true, false);
  const auto ik = ArmIk::make(robot);
  ASSERT_TRUE(ik) << ik.error().message;
  EXPECT_EQ(ik->kind(), IkKind::kSphericalWrist);
  EXPECT_EQ(ik->sampled_joints(), 1);
  EXPECT_EQ(solved_share(robot, *ik, true), 1.0);
  expect_views_look_at_their_targets(robot, *ik);
}

TEST(AnyArm, IsSolvedNumericallyWhenNothingElseFits) {
  for (const RobotModel& robot : {rail_robot(), crooked_arm(6), crooked_arm(7)}) {
    const auto ik = ArmIk::make(robot);
    ASSERT_TRUE(ik) << ik.error().message;
    EXPECT_EQ(ik->kind(), IkKind::kNumeric);
    EXPECT_GT(solved_share(robot, *ik, false), 0.95);
    expect_views_look_at_their_targets(robot, *ik);
  }
}

TEST(AnyArm, NumericIsAsGoodAsTheClosedForm) {
  const RobotModel& robot = shipped_robot();
  const auto closed = ArmIk::make(robot);
  const auto numeric = ArmIk::make_numeric(robot);
  ASSERT_TRUE(closed && numeric);
  Rng random(8);
  std::vector<Configuration> a;
  std::vector<Configuration> b;
  int closed_only = 0;
  int solved = 0;
  const Box& box = robot.workspace(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 position{random.uniform(box.min().x(), box.max().x()),
                        random.uniform(box.min().y(), box.max().y()),
                        random.uniform(box.min().z(), box.max().z())};
    const Vec3 target = position + Vec3{random.normal(), random.normal(), random.normal()};
    closed->solve_view(position, target, robot.home("side_1"), a);
    numeric->solve_view(position, target, robot.home("side_1"), b);
    EXPECT_TRUE(!a.empty() || b.empty());  // what the closed form calls out of reach, is
    solved += a.empty() ? 0 : 1;
    closed_only += !a.empty() && b.empty() ? 1 : 0;
  }
  EXPECT_GT(solved, 200);
  EXPECT_LT(closed_only, solved / 50);
}

TEST(AnyArm, OfTooManyJointsIsRefused) {
  ArmBuilder arm;
  for (int i = 0; i <= kMaxArmJoints; ++i) arm.joint(placed(0.1, 0, 0.1));
  arm.setup.base_link = "base";
  arm.setup.camera_frame = arm.robot.links.back().name;
  const auto robot = RobotModel::make(arm.robot, arm.setup);
  ASSERT_FALSE(robot);
  EXPECT_NE(robot.error().message.find("at most 10"), std::string::npos) << robot.error().message;
}

}  // namespace
}  // namespace canopeer
