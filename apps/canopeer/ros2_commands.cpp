#include "ros2_commands.h"

#include "canopeer/ros2/ros2_robot.h"
#include "mission_arguments.h"

namespace canopeer::app {
namespace {

std::string fault_list() {
  std::string text = "Faults, each as NAME, NAME:VALUES or NAME:VALUES@MOTION:\n";
  for (const std::string& line : ros2_robot_faults()) text += "  " + line + "\n";
  return text;
}

void add_ros2_robot(CLI::App& ros2, Ros2RobotArguments& a) {
  CLI::App* robot = ros2.add_subcommand(
      "robot", "Be the simulated robot of a mission on ROS 2: controllers, joint states, camera");
  add_mission(*robot, a.mission);
  robot
      ->add_option("--fault", a.faults,
                   "What goes wrong, see below (repeatable); later by topic "
                   "/simulated_robot/fault")
      ->expected(1)
      ->take_all();
  robot->add_option("--for", a.for_s, "End after so many seconds (default: when interrupted)")
      ->check(CLI::Range(0.0, 1e9));
  robot->add_option("--camera-rate", a.camera_rate_hz, "Frames a second, while somebody listens")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  robot->add_option("--camera-latency", a.camera_latency_s, "Seconds from exposure to sending")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  robot->add_option("--color-encoding", a.color_encoding, "Of colour images")
      ->check(CLI::IsMember({"rgb8", "bgr8", "rgba8", "bgra8", "mono8"}))
      ->capture_default_str();
  robot->add_option("--depth-encoding", a.depth_encoding, "Of depth images")
      ->check(CLI::IsMember({"16UC1", "32FC1"}))
      ->capture_default_str();
  robot->add_option("--joint-rate", a.joint_rate_hz, "Joint states a second")
      ->check(CLI::Range(10.0, 1000.0))
      ->capture_default_str();
  robot->add_flag("--split-joint-states", a.split_joint_states,
                  "Arm and trolley are said by two publishers");
  robot->add_flag("--sim-time", a.sim_time, "Time of its own, said on /clock");
  robot->add_option("--sim-rate", a.sim_rate, "How fast that time runs")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  robot->footer(fault_list());
  robot->callback([&a] { ros2_robot(a); });
}

void add_ros2_check(CLI::App& ros2, Ros2CheckArguments& a) {
  CLI::App* check = ros2.add_subcommand(
      "check", "Say what of a mission's robot is there on ROS 2, what fits, and what to change");
  add_mission(*check, a.mission);
  check->add_option("--listen", a.listen_s, "Seconds to measure rates for")
      ->check(CLI::Range(0.5, 600.0))
      ->capture_default_str();
  check->add_flag("--move", a.move,
                  "Move the arm slowly, a hand's breadth about where it is, to check the camera's "
                  "mounting and clock in front of a still scene");
  check->callback([&a] { ros2_check(a); });
}

}  // namespace

void add_ros2(CLI::App& app, Ros2Arguments& arguments, const RunRegistries& registries) {
  arguments.robot.mission.registries = &registries;
  CLI::App* ros2 = app.add_subcommand("ros2", "Robots on ROS 2");
  ros2->require_subcommand(1);
  add_ros2_robot(*ros2, arguments.robot);
  arguments.check.mission.registries = &registries;
  add_ros2_check(*ros2, arguments.check);
}

}  // namespace canopeer::app
