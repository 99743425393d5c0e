#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/config/robot_file.h"
#include "canopeer/ros2/ros2_site.h"
#include "canopeer/run/stage.h"
#include "ros_fixture.h"
#include "support/must.h"
#include "support/planning_fixture.h"
#include "test_controller.h"

namespace canopeer::ros {
namespace {

using test::test_robot;
using testing_support::TestController;

/// A mission on the shipped robot that waits but a moment for it.
MissionFile mission() {
  MissionFile file;
  file.robot = CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml";
  file.mission.segments.resize(1);
  file.mission.segments[0].trolley.travel_m = 1.0;
  file.ros2.emplace();
  file.ros2->domain = canopeer::testing_support::own_domain();
  file.ros2->discovery_s = 0.5;
  return file;
}

std::string error_of(const MissionFile& file, const SiteCallbacks& callbacks = {}) {
  const auto site = make_ros2_site({file, test_robot(), callbacks});
  return site ? "none" : site.error().message;
}

TEST(Ros2Site, SaysAllThatIsMissingAtOnce) {
  const std::string error = error_of(mission());
  for (const char* part :
       {"ros2: missing after", "joint states of shoulder_pan_joint",
        "/joint_states (sensor_msgs/msg/JointState): nobody publishes it",
        "/joint_trajectory_controller/follow_joint_trajectory "
        "(control_msgs/action/FollowJointTrajectory): nobody serves such an action",
        "/camera/color/image_raw (sensor_msgs/msg/Image): nobody publishes it",
        "nobody else is in domain", "ROS_DOMAIN_ID"}) {
    EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
  }
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(Ros2Site, SaysWhatIsThereInPlaceOfWhatIsMissing) {
  const auto node = testing_support::make_node("robot");
  const TestController controller(*node, "/scaled/follow_joint_trajectory",
                                  {"ur_elbow", "ur_wrist"}, {0.0, 0.0});
  MissionFile file = mission();
  file.ros2->discovery_s = 3.0;
  file.ros2->use_sim_time = true;
  file.ros2->trolley.kind = Ros2TrolleySettings::Kind::topics;
  file.ros2->trolley.travel_command = "/travel";
  const std::string error = error_of(file);
  for (const char* part :
       {"said in their place are ur_elbow ur_wrist (ros2.arm.joint_names)",
        "there is /scaled/follow_joint_trajectory in its place", "nobody says the time",
        "where the trolley is: travel (joint trolley_travel)",
        "for the trolley: a subscriber of /travel (std_msgs/msg/Float64)",
        "1 others are in domain"}) {
    EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
  }
}

TEST(Ros2Site, WaitsNoLongerThanAPersonWants) {
  MissionFile file = mission();
  file.ros2->discovery_s = 600.0;
  SiteCallbacks callbacks;
  callbacks.stop_asked = [] { return true; };
  EXPECT_NE(error_of(file, callbacks).find("stopped while waiting"), std::string::npos);
}

TEST(Ros2Site, RefusesSettingsThatAreWrong) {
  MissionFile file = mission();
  file.ros2->arm.speed_scale = 0.0;
  EXPECT_NE(error_of(file).find("ros2.arm.speed_scale"), std::string::npos);
  file = mission();
  file.ros2->node = "not a name";
  EXPECT_NE(error_of(file).find("not a name"), std::string::npos);
}

TEST(Ros2Site, IsRegisteredWithItsManners) {
  SiteRegistry sites = SiteRegistry::built_in();
  add_ros2_site(sites);
  add_ros2_site(sites);
  EXPECT_FALSE(sites.one_line("ros2").empty());
  const SiteManners manners = sites.manners("ros2");
  EXPECT_TRUE(manners.realtime);
  MissionFile file = mission();
  file.ros2->arm.speed_scale = 0.3;
  EXPECT_EQ(manners.arm_speed(file), 0.3);
  EXPECT_FALSE(sites.manners("simulation").realtime);
}

}  // namespace
}  // namespace canopeer::ros
