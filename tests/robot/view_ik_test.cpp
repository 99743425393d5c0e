#include "canopeer/robot/view_ik.h"

#include <numbers>

#include "robot_fixture.h"

namespace canopeer {
namespace {

const ArmIk& shipped_ik() {
  static const Expected<ArmIk> ik = ArmIk::make(shipped_robot());
  if (!ik) ADD_FAILURE() << ik.error().message;
  return *ik;
}

TEST(ArmIk, EveryBranchReachesThePoseAndTheOriginalIsAmongThem) {
  const RobotModel& robot = shipped_robot();
  Rng random(1);
  std::vector<Configuration> found;
  std::size_t most = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Configuration q = random_configuration(random, robot);
    const Pose T = robot.T_base_camera(q);
    found.clear();
    shipped_ik().solve(T, q, found);
    double nearest = 1.0;
    for (const Configuration& candidate : found) {
      EXPECT_TRUE(robot.within_limits(candidate));
      EXPECT_TRUE(robot.T_base_camera(candidate).isApprox(T, 1e-6)) << candidate.transpose();
      nearest = std::min(nearest, (candidate - q).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LT(nearest, 1e-5) << q.transpose();
    most = std::max(most, found.size());
  }
  EXPECT_EQ(most, 8U);
}

TEST(ArmIk, KeepsTheHomeStatesThoughTheyAreWristSingularities) {
  const RobotModel& robot = shipped_robot();
  for (const char* name : {"side_1", "side_2"}) {
    std::vector<Configuration> found;
    const Configuration& home = robot.home(name);
    shipped_ik().solve(robot.T_base_camera(home), home, found);
    double nearest = 1.0;
    for (const Configuration& q : found) {
      EXPECT_TRUE(robot.T_base_camera(q).isApprox(robot.T_base_camera(home), 1e-6));
      nearest = std::min(nearest, (q - home).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LT(nearest, 1e-5);
  }
}

TEST(ArmIk, BringsJointsNearTheReferenceWithinTheLimits) {
  const RobotModel& robot = shipped_robot();
  Rng random(2);
  std::vector<Configuration> found;
  for (int trial = 0; trial < 500; ++trial) {
    const Configuration reference = random_configuration(random, robot);
    found.clear();
    shipped_ik().solve(robot.T_base_camera(random_configuration(random, robot)), reference, found);
    for (const Configuration& q : found) {
      for (int i = 0; i < 6; ++i) {
        for (const double turn : {-2.0 * std::numbers::pi, 2.0 * std::numbers::pi}) {
          const double other = q[i] + turn;
          if (other < robot.limits().lower[i] || other > robot.limits().upper[i]) continue;
          EXPECT_LE(std::abs(q[i] - reference[i]), std::abs(other - reference[i]) + 1e-9);
        }
      }
    }
  }
}

TEST(ArmIk, ViewsLookAtTheirTargetNearestFirst) {
  const RobotModel& robot = shipped_robot();
  const Configuration& home = robot.home("side_1");
  Rng random(3);
  int reachable = 0;
  std::vector<Configuration> found;
  for (int trial = 0; trial < 500; ++trial) {
    const Box& box = robot.workspace(1);
    const Vec3 position{random.uniform(box.min().x(), box.max().x()),
                        random.uniform(box.min().y(), box.max().y()),
                        random.uniform(box.min().z(), box.max().z())};
    const Vec3 target{random.uniform(-0.4, 1.0), 0.9, random.uniform(-0.2, 0.7)};
    shipped_ik().solve_view(position, target, home, found);
    reachable += found.empty() ? 0 : 1;
    double last = 0.0;
    for (const Configuration& q : found) {
      const Pose T = robot.T_base_camera(q);
      EXPECT_LT((T.translation() - position).norm(), 1e-6);
      EXPECT_LT((T.linear().col(2) - (target - position).normalized()).norm(), 1e-6);
      EXPECT_GE(joint_distance(q, home), last);
      last = joint_distance(q, home);
    }
  }
  EXPECT_GT(reachable, 200);
}

TEST(ArmIk, OutOfReachIsAnOrdinaryNo) {
  std::vector<Configuration> found;
  shipped_ik().solve_view(Vec3(0.0, 2.0, 0.5), Vec3(0.0, 3.0, 0.5), shipped_robot().home("side_1"),
                          found);
  EXPECT_TRUE(found.empty());
}

TEST(ArmIk, SolvesAnArmOfAnotherBuildNumerically) {
  RobotDescription description = shipped_robot().description();
  for (Joint& joint : description.joints) {
    if (joint.name == "elbow_joint")
      joint.T_parent_joint.rotate(Eigen::AngleAxisd(0.1, Vec3::UnitX()));
  }
  const auto robot = RobotModel::make(description, shipped_robot().setup());
  ASSERT_TRUE(robot);
  const auto ik = ArmIk::make(*robot);
  ASSERT_TRUE(ik) << ik.error().message;
  EXPECT_EQ(ik->kind(), IkKind::kNumeric);
}

TEST(ArmIk, TakesTheSameArmDescribedWithOtherFramesAndSigns) {
  RobotDescription description = shipped_robot().description();
  for (Joint& joint : description.joints) {
    if (joint.name == "elbow_joint" || joint.name == "wrist_2_joint") joint.axis = -joint.axis;
    // Somewhere else along the same axis, and with another zero.
    if (joint.name == "shoulder_pan_joint")
      joint.T_parent_joint.rotate(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
  }
  const auto robot = RobotModel::make(description, shipped_robot().setup());
  ASSERT_TRUE(robot);
  const auto ik = ArmIk::make(*robot);  // proves itself against forward kinematics
  EXPECT_TRUE(ik) << ik.error().message;
}

}  // namespace
}  // namespace canopeer
