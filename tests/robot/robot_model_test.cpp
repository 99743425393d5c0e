#include "canopeer/robot/robot_model.h"

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <numbers>

#include "canopeer/robot/path_timing.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr double kPi = std::numbers::pi;

// a, d, alpha of the UR5e.
constexpr double kDh[6][3] = {{0.0, 0.1625, kPi / 2}, {-0.425, 0.0, 0.0},      {-0.3922, 0.0, 0.0},
                              {0.0, 0.1333, kPi / 2}, {0.0, 0.0997, -kPi / 2}, {0.0, 0.0996, 0.0}};

/// From the table alone: base turned by 180°, flange, camera 0.02 m ahead with its y axis down.
Pose camera_by_table(const Configuration& q) {
  Pose T = Pose(Eigen::AngleAxisd(kPi, Vec3::UnitZ()));
  for (int i = 0; i < 6; ++i) {
    T = T * Eigen::AngleAxisd(q[i], Vec3::UnitZ()) * Eigen::Translation3d(kDh[i][0], 0, kDh[i][1]) *
        Eigen::AngleAxisd(kDh[i][2], Vec3::UnitX());
  }
  return T * Eigen::Translation3d(0, 0, 0.02) * Eigen::AngleAxisd(kPi, Vec3::UnitZ());
}

Pose flange_by_kdl(const Configuration& q) {
  KDL::Chain chain;
  for (const auto& row : kDh)
    chain.addSegment(
        KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(row[0], row[2], row[1], 0.0)));
  KDL::JntArray joints(6);
  joints.data = q;
  KDL::Frame frame;
  KDL::ChainFkSolverPos_recursive(chain).JntToCart(joints, frame);
  Pose T = Pose::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) T.linear()(r, c) = frame.M(r, c);
    T.translation()[r] = frame.p(r);
  }
  return T;
}

TEST(RobotModel, AgreesWithTheDenavitHartenbergTableAndKdl) {
  const RobotModel& robot = shipped_robot();
  Rng random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Configuration q = random_configuration(random, robot);
    const Pose ours = robot.T_base_camera(q);
    EXPECT_TRUE(ours.isApprox(camera_by_table(q), 1e-9)) << q.transpose();
    const Pose flange = Eigen::AngleAxisd(kPi, Vec3::UnitZ()) * flange_by_kdl(q);
    EXPECT_LT((flange * Vec3(0, 0, 0.02) - ours.translation()).norm(), 1e-9);
  }
}

TEST(RobotModel, LooksAtTheRowFromItsHomeStates) {
  const RobotModel& robot = shipped_robot();
  const Pose side_1 = robot.T_base_camera(robot.home("side_1"));
  EXPECT_LT((side_1.translation() - Vec3(0.578, 0.253, 0.086)).norm(), 1e-3);
  EXPECT_TRUE(side_1.linear().col(2).isApprox(Vec3::UnitY(), 1e-9));
  EXPECT_TRUE(side_1.linear().col(1).isApprox(-Vec3::UnitZ(), 1e-9));
  const Pose side_2 = robot.T_base_camera(robot.home("side_2"));
  EXPECT_LT((side_2.translation() - Vec3(0.578, 0.014, 0.086)).norm(), 1e-3);
  EXPECT_TRUE(side_2.linear().col(2).isApprox(-Vec3::UnitY(), 1e-9));
  EXPECT_TRUE(side_2.linear().col(1).isApprox(-Vec3::UnitZ(), 1e-9));
}

TEST(RobotModel, SlowedDownTakesLongerForTheSameMotions) {
  RobotModel slow = shipped_robot();
  slow.slow_down(0.25);
  const Configuration home = slow.home("side_1");
  Configuration corner = home;
  corner[0] += 0.5;
  Configuration end = corner;
  end[1] -= 0.4;
  const JointPath path{{home, corner, end}, {0.0, 0.05, 0.0}};
  const PathMotion quickly(path, shipped_robot().limits());
  const PathMotion slowly(path, slow.limits());
  EXPECT_NEAR(slowly.duration_s(), 4.0 * quickly.duration_s(), 1e-9);
  for (double t_s = 0.0; t_s < quickly.duration_s(); t_s += 0.1) {
    EXPECT_LT((slowly.at(4.0 * t_s) - quickly.at(t_s)).norm(), 1e-9);
  }
}

TEST(RobotModel, StandsOnItsTrolleyAtEveryStop) {
  const RobotModel& robot = shipped_robot();
  for (int stop = 0; stop < 4; ++stop) {
    const Pose T = robot.T_world_base({static_cast<double>(stop), 0.7});
    EXPECT_TRUE(T.translation().isApprox(Vec3(0.11, -1.874 + stop, 1.389), 1e-9));
    EXPECT_TRUE(T.linear().col(0).isApprox(Vec3::UnitY(), 1e-9));
  }
  const Box region = transformed(robot.sampling_region(1), robot.T_world_base({}));
  EXPECT_NEAR(region.min().x(), -1.19, 1e-9);
  EXPECT_NEAR(region.max().x(), -0.49, 1e-9);
  EXPECT_NEAR(region.min().z(), 0.389, 1e-9);
  const Box workspace = transformed(robot.workspace(2), robot.T_world_base({}));
  EXPECT_NEAR(workspace.min().x(), -0.38, 1e-9);
  EXPECT_NEAR(workspace.max().x(), 0.41, 1e-9);
}

TEST(RobotModel, LinkPosesEndAtTheCamera) {
  const RobotModel& robot = shipped_robot();
  Rng random(2);
  std::vector<Pose> poses;
  const TrolleyState trolley{1.3, 0.4};
  robot.link_poses(robot.home("side_1"), trolley, poses);
  const Configuration q = random_configuration(random, robot);
  robot.arm_link_poses(q, poses);
  EXPECT_TRUE(poses[robot.link_index("camera_optical_frame")].isApprox(
      robot.T_world_base(trolley) * robot.T_base_camera(q), 1e-9));
}

TEST(RobotModel, NamesWhatIsWrongWithASetup) {
  const RobotModel& robot = shipped_robot();
  const auto message = [&](auto&& spoil) {
    RobotDescription description = robot.description();
    RobotSetup setup = robot.setup();
    spoil(description, setup);
    const auto made = RobotModel::make(description, setup);
    return made ? std::string("accepted") : made.error().message;
  };
  EXPECT_EQ(message([](auto&, auto&) {}), "accepted");
  EXPECT_NE(message([](auto&, RobotSetup& s) { s.camera_frame = "camera"; }).find("'camera'"),
            std::string::npos);
  EXPECT_NE(message([](auto&, RobotSetup& s) {
              std::swap(s.arm_joints[1], s.arm_joints[2]);
            }).find("from base to tool"),
            std::string::npos);
  EXPECT_NE(message([](auto&, RobotSetup& s) { s.home["side_1"][2] = 4.0; }).find("'side_1'"),
            std::string::npos);
  EXPECT_NE(message([](auto&, RobotSetup& s) { s.travel_joint = "elbow_joint"; }).find("prismatic"),
            std::string::npos);
  EXPECT_NE(message([](RobotDescription& d, auto&) { d.joints.pop_back(); }).find("one tree"),
            std::string::npos);
}

TEST(JointDistance, SumsTheAbsoluteDifferences) {
  EXPECT_DOUBLE_EQ(joint_distance(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(1, -1, 2)), 3.0);
}

}  // namespace
}  // namespace canopeer
