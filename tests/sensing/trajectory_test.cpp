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

TEST(Trajectory, OfTwoPosesAtOneTimeTheFirstCounts) {
  const auto trajectory = Trajectory::parse(
      "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n2 9 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n", "poses.txt");
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  EXPECT_EQ(trajectory->poses().size(), 3U);
  EXPECT_EQ(trajectory->at(2.0, 1.0)->translation().x(), 1.0);
  ASSERT_EQ(trajectory->notices().size(), 1U);
  EXPECT_NE(trajectory->notices()[0].find("poses.txt:3: 1 poses left out"), std::string::npos);
}

TEST(Trajectory, ErrorsNameTheLine) {
  EXPECT_NE(message("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n").find("poses.txt:2: expected the 8 numbers"),
            std::string::npos);
  EXPECT_NE(message("0 0 0 zero 0 0 0 1\n").find("poses.txt:1"), std::string::npos);
  EXPECT_NE(message("0 0 0 zero 0 0 0 1\n").find("zero"), std::string::npos);
  EXPECT_NE(message("0 0 nan 0 0 0 0 1\n").find("nan"), std::string::npos);
  EXPECT_NE(message("0 0 0 0 0 0 0 0\n").find("quaternion"), std::string::npos);
  EXPECT_NE(message("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n").find("poses.txt:2: the time stamp"),
            std::string::npos);
  EXPECT_NE(message("# nothing\n").find("no pose"), std::string::npos);
}

// A quarter turn about x at (1, 2, 3), then the same a step along x.
constexpr char kTum[] = "1 1 2 3 0.7071068 0 0 0.7071068\n2 1.5 2 3 0.7071068 0 0 0.7071068\n";

void expect_quarter_turns(const std::string& text) {
  const auto trajectory = Trajectory::parse(text, "poses.txt");
  ASSERT_TRUE(trajectory) << text << trajectory.error().message;
  ASSERT_EQ(trajectory->poses().size(), 2U) << text;
  Pose expected = Pose::Identity();
  expected.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix();
  for (const double x : {1.0, 1.5}) {
    expected.translation() = Vec3(x, 2, 3);
    const Pose& pose = trajectory->poses()[x == 1.0 ? 0 : 1].T_world_camera;
    EXPECT_TRUE(pose.isApprox(expected, 1e-6)) << text << pose.matrix();
  }
}

TEST(Trajectory, ColumnsAreTakenByTheirNames) {
  const std::string w_first[] = {
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z "
      "[], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1]\n",
      "#timestamp [s],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z [],vx,vy,vz,bx\n",
      "timestamp,tx,ty,tz,qw,qx,qy,qz,v_x,v_y,v_z,sigma_x\n",
      "# time x y z qw qx qy qz vx vy vz bw_x\n",
      "t;pos_x;pos_y;pos_z;quat_w;quat_x;quat_y;quat_z;a.x;a.y;a.z;w.x\n",
      "\"time\",\"position.x\",\"position.y\",\"position.z\",\"orientation.w\",\"orientation.x\","
      "\"orientation.y\",\"orientation.z\",\"linear.x\",\"linear.y\",\"linear.z\",\"angular.x\"\n",
      "# timestamp [s] tx [m] ty [m] tz [m] qw [] qx [] qy [] qz [] vx [m/s] vy [m/s] vz [m/s] b "
      "[x]\n",
  };
  const std::string rows =
      "1,1,2,3,0.7071068,0.7071068,0,0,9,9,9,9\n2,1.5,2,3,0.7071068,0.7071068,0,0,9,9,9,9\n";
  for (const std::string& head : w_first) {
    expect_quarter_turns(head + rows);
    EXPECT_TRUE(Trajectory::parse(head + rows, "t")->order_is_said()) << head;
  }
  expect_quarter_turns(kTum);
  EXPECT_FALSE(Trajectory::parse(kTum, "t")->order_is_said());
  expect_quarter_turns(std::string("\xEF\xBB\xBF# timestamp tx ty tz qx qy qz qw\n") + kTum);
  // rostopic echo -p
  expect_quarter_turns(
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.pose.position.x,"
      "field.pose.position.y,field.pose.position.z,field.pose.orientation.x,field.pose.orientation."
      "y,"
      "field.pose.orientation.z,field.pose.orientation.w\n"
      "7,1,1000000000,map,1,2,3,0.7071068,0,0,0.7071068\n"
      "8,2,2000000000,map,1.5,2,3,0.7071068,0,0,0.7071068\n");
  EXPECT_NE(Trajectory::parse("%time,field.header.stamp,field.x,field.y,field.z,field.qx,field.qy,"
                              "field.qz,field.qw\n9,2500000000,0,0,0,0,0,0,1\n",
                              "t")
                ->at(2.5, 1.0),
            std::nullopt);
  EXPECT_NE(message("time,x,y,z,roll,pitch,yaw\n1,2,3,4,0,0,0\n").find("poses.txt:1: names no"),
            std::string::npos);
}

TEST(Trajectory, MatricesAndPosesWithoutTimeStampsAreReadToo) {
  const std::string one = "1 0 0 1 0 0 -1 2 0 1 0 3", two = "1 0 0 1.5 0 0 -1 2 0 1 0 3";
  const std::string untimed[] = {
      one + "\n" + two + "\n",
      one + " 0 0 0 1\n" + two + " 0 0 0 1\n",
      "1 2 3 0.7071068 0 0 0.7071068\n1.5 2 3 0.7071068 0 0 0.7071068\n",
      "1 0 0 1\n0 0 -1 2\n0 1 0 3\n\n1 0 0 1.5\n0 0 -1 2\n0 1 0 3\n\n",
      "0 0 1\n1 0 0 1\n0 0 -1 2\n0 1 0 3\n0 0 0 1\n1 1 2\n1 0 0 1.5\n0 0 -1 2\n0 1 0 3\n0 0 0 1\n",
  };
  for (const std::string& text : untimed) {
    expect_quarter_turns(text);
    EXPECT_FALSE(Trajectory::parse(text, "t")->timed());
  }
  const std::string timed = "10 " + one + "\n11 " + two + "\n";
  expect_quarter_turns(timed);
  EXPECT_EQ(Trajectory::parse(timed, "t")->poses()[1].time_s, 11.0);
  EXPECT_NE(message("1 0 0 1 0 0 1 2 0 1 0 3\n").find("left-handed"), std::string::npos);
  EXPECT_NE(message("1 0 0 1 0 2 1 2 0 1 0 3\n").find("poses.txt:1: the 12 numbers"),
            std::string::npos);
  EXPECT_NE(message("1 0 0 1\n0 0 -1 2\n").find("cut off"), std::string::npos);
  EXPECT_NE(message("1 2 3 4 5\n").find("name them in a first line"), std::string::npos);
}

TEST(Trajectory, TimeStampsAreInSecondsOrSayTheirUnit) {
  const auto time_of = [](const std::string& text) {
    return Trajectory::parse(text, "t")->poses().at(0).time_s;
  };
  const std::string pose = " 0 0 0 0 0 0 1\n";
  EXPECT_NEAR(time_of("1403636579763555584" + pose), 1403636579.763555584, 1e-5);
  EXPECT_NEAR(time_of("1403636579763555" + pose), 1403636579.763555, 1e-5);
  EXPECT_NEAR(time_of("1403636579763" + pose), 1403636579.763, 1e-5);
  EXPECT_EQ(time_of("1403636579.75" + pose), 1403636579.75);
  EXPECT_EQ(time_of("#timestamp [ns] tx ty tz qx qy qz qw\n2500000000" + pose), 2.5);
  EXPECT_EQ(time_of("#timestamp_ms tx ty tz qx qy qz qw\n2500" + pose), 2.5);
}

}  // namespace
}  // namespace canopeer
