#include "canopeer/ros2/arm/motion_ending.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

using TrajectoryResult = FollowJointTrajectory::Result;

constexpr double kHeldUp_s = 0.5;  // who merely lags behind does not stand still for so long
/// Controllers look at one instant, we a little later.
constexpr double kBelief = 1.5;
/// Where the tolerance is the controller's own affair; nearer is no place on the way any more.
constexpr double kFarOff = 0.05;

bool speaks_of(const std::string& text, std::initializer_list<std::string_view> words) {
  std::string low = text;
  std::transform(low.begin(), low.end(), low.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return low.find(word) != std::string::npos; });
}

/// A controller that was switched off is one that a person or a safety function has stopped.
bool speaks_of_stop(const std::string& text) {
  return speaks_of(text, {"protective", "emergency", "e-stop", "estop", "safeguard", "safety stop",
                          "deactivat"});
}
bool speaks_of_others(const std::string& text) {
  return speaks_of(text, {"preempt", "new incoming", "new goal", "another goal", "superseded"});
}

std::string place_text(const MotionReport& report) {
  return report.farthest_joint + " is " + figure(report.off_goal, 3) + " from its goal";
}

MotionOutcome outcome(MotionEnd end, std::string why) {
  MotionOutcome outcome;
  outcome.end = end;
  outcome.why = std::move(why);
  return outcome;
}

MotionOutcome succeeded(const MotionReport& report) {
  const TrajectoryResult& result = report.goal.result;
  if (result.error_code != TrajectoryResult::SUCCESSFUL) {
    return outcome(MotionEnd::aborted, in_words(result) + ", though said to have succeeded");
  }
  const double allowed = report.goal_tolerance > 0.0 ? kBelief * report.goal_tolerance : kFarOff;
  if (report.off_goal <= allowed) return outcome(MotionEnd::arrived, {});
  return outcome(MotionEnd::aborted,
                 "said to have arrived, but " + place_text(report) +
                     "; tune the controller, or raise ros2.arm.goal_tolerance_rad");
}

}  // namespace

std::string in_words(const TrajectoryResult& result) {
  const auto with_text = [&](const char* meaning) {
    return meaning + (result.error_string.empty() ? "" : ": " + result.error_string);
  };
  switch (result.error_code) {
    case TrajectoryResult::SUCCESSFUL:
      return with_text("no error is given");
    case TrajectoryResult::INVALID_GOAL:
      return with_text("the controller takes the trajectory for invalid");
    case TrajectoryResult::INVALID_JOINTS:
      return with_text("the controller has other joints (ros2.arm.joint_names)");
    case TrajectoryResult::OLD_HEADER_TIMESTAMP:
      return with_text("the trajectory came too late, or clocks differ");
    case TrajectoryResult::PATH_TOLERANCE_VIOLATED:
      return with_text("a joint left its path farther than allowed");
    case TrajectoryResult::GOAL_TOLERANCE_VIOLATED:
      return with_text("a joint did not reach its goal as closely as wanted, or in time");
    default:
      return with_text(("error " + std::to_string(result.error_code)).c_str());
  }
}

MotionOutcome motion_ending(const MotionReport& report) {
  const GoalEnding& goal = report.goal;
  const std::string& said = goal.result.error_string;
  if (goal.state == GoalState::succeeded) return succeeded(report);
  if (goal.state == GoalState::unknown) {
    return outcome(MotionEnd::stopped,
                   "the controller does not know the motion any more: it was started anew");
  }
  if (report.safety_stop) return outcome(MotionEnd::stopped, *report.safety_stop);
  if (goal.cancelled) return outcome(MotionEnd::cancelled, *goal.cancelled);
  if (speaks_of_stop(said)) return outcome(MotionEnd::stopped, said);
  if (speaks_of_others(said)) return outcome(MotionEnd::preempted, said);
  if (goal.state == GoalState::canceled) {
    return outcome(MotionEnd::preempted,
                   "somebody else cancelled the motion" + (said.empty() ? "" : ": " + said));
  }
  if (report.stood_still_s >= kHeldUp_s && report.off_goal > kFarOff) {
    return outcome(MotionEnd::stopped, "the arm stood still for " +
                                           figure(report.stood_still_s, 1) + " s on its way (" +
                                           place_text(report) +
                                           "), then the controller gave up: a protective stop, or "
                                           "something holds it; " +
                                           in_words(goal.result));
  }
  return outcome(MotionEnd::aborted, in_words(goal.result));
}

}  // namespace canopeer::ros
