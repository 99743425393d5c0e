#include <cstdio>

#include "canopeer/ros2/ros2_check.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "robot_source.h"
#include "ros2_commands.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

const char* verdict_word(Ros2Finding::Verdict verdict) {
  switch (verdict) {
    case Ros2Finding::Verdict::ok:
      return "ok";
    case Ros2Finding::Verdict::notice:
      return "notice";
    default:
      return "wrong";
  }
}

void print_finding(const Ros2Finding& finding) {
  std::printf("%-7s %-16s %s\n", verdict_word(finding.verdict), finding.what.c_str(),
              finding.text.c_str());
  std::fflush(stdout);
}

}  // namespace

/// Says what of a robot on ROS 2 is there and fits, and what to change.
void ros2_check(const Ros2CheckArguments& arguments) {
  const std::atomic<bool>& stop = catch_stop_signals();
  const MissionFile file = load(arguments.mission);
  RobotModel robot = robot_of(file);
  if (arguments.move && file.ros2.value_or(Ros2Settings()).confirm) {
    stop_with(kBadInput, {"ros2.confirm is on and --move asks nobody; with somebody at the stop: "
                          "--set ros2.confirm=false"});
  }
  robot.slow_down(file.ros2.value_or(Ros2Settings()).arm.speed_scale);
  Ros2CheckOptions options;
  options.listen_s = arguments.listen_s;
  options.move = arguments.move;
  options.on_finding = print_finding;
  options.stop_asked = [&stop] { return stop.load(); };
  const auto findings = value_or_stop(check_ros2_robot(file, robot, options), kBadInput);
  int wrong = 0;
  for (const Ros2Finding& finding : findings) {
    wrong += finding.verdict == Ros2Finding::Verdict::wrong;
  }
  if (wrong > 0) stop_with(kFailed, {std::to_string(wrong) + " thing(s) wrong with this robot"});
}

}  // namespace canopeer::app
