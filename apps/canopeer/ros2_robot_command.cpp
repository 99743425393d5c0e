#include <chrono>
#include <cstdio>
#include <thread>

#include "canopeer/ros2/ros2_robot.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "robot_source.h"
#include "ros2_commands.h"
#include "stop_signal.h"
#include "world_builder.h"

namespace canopeer::app {
namespace {

Ros2RobotOptions robot_options(const Ros2RobotArguments& a) {
  Ros2RobotOptions options;
  options.node = a.node;
  options.faults = a.faults;
  options.camera_rate_hz = a.camera_rate_hz;
  options.camera_latency_s = a.camera_latency_s;
  options.color_encoding = a.color_encoding;
  options.depth_encoding = a.depth_encoding;
  options.joint_rate_hz = a.joint_rate_hz;
  options.split_joint_states = a.split_joint_states;
  options.sim_time = a.sim_time;
  options.sim_rate = a.sim_rate;
  return options;
}

void print_report(const Ros2RobotReport& r) {
  std::printf("goals             %d: %d arrived, %d refused, %d cut short\n", r.goals, r.arrived,
              r.refused, r.cut_short);
  std::printf("motions           %d: %d with collisions, %d that touched leaves\n", r.motions,
              r.collisions, r.plant_contacts);
  std::printf("frames            %d\n", r.frames);
  std::printf("joint states      at most %.0f ms apart\n", 1e3 * r.longest_gap_s);
}

}  // namespace

void ros2_robot(const Ros2RobotArguments& arguments) {
  const std::atomic<bool>& stop = catch_stop_signals();
  const MissionFile file = load(arguments.mission);
  const RobotModel robot = robot_of(file);
  ImportedScene world = build_world_or_stop(file.world, file.mission.seed);
  const auto running = value_or_stop(
      Ros2Robot::start(file, robot, std::move(world.scene), robot_options(arguments)), kBadInput);
  std::printf("the robot of %s is on ROS 2, domain %d; Ctrl-C ends it\n", file.mission.name.c_str(),
              file.ros2.value_or(Ros2Settings()).domain.value_or(0));
  std::fflush(stdout);
  const auto begin = std::chrono::steady_clock::now();
  const auto over = [&] {
    const std::chrono::duration<double> ran = std::chrono::steady_clock::now() - begin;
    return stop || (arguments.for_s && ran.count() >= *arguments.for_s);
  };
  while (!over()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  print_report(running->report());
}

}  // namespace canopeer::app
