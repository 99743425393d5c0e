#include "canopeer/ros2/robot/robot_faults.h"

#include <algorithm>
#include <charconv>

namespace canopeer::ros {
namespace {

constexpr FaultKind kFaultKinds[] = {
    {RobotFault::reject, "reject", "TIMES", {1, 0}, true, "goals of the arm are refused"},
    {RobotFault::abort,
     "abort",
     "SHARE,TIMES",
     {0.5, 1},
     true,
     "the controller aborts, that share of the motion's time in"},
    {RobotFault::preempt,
     "preempt",
     "SHARE,TIMES",
     {0.5, 1},
     true,
     "another client takes the arm over, and has it stand still"},
    {RobotFault::protective_stop,
     "protective_stop",
     "SHARE,TIMES",
     {0.5, 1},
     true,
     "the arm stops at once; the controller takes no goals until ~/release is called"},
    {RobotFault::slow,
     "slow",
     "SCALE",
     {0.3, 0},
     false,
     "a pendant slows all motions to that share"},
    {RobotFault::vanish, "vanish", "", {0, 0}, false, "nothing is said and answered any more"},
    {RobotFault::joint_states_silent,
     "joint_states_silent",
     "",
     {0, 0},
     false,
     "no joint states, no tf"},
    {RobotFault::camera_silent, "camera_silent", "", {0, 0}, false, "no images"},
    {RobotFault::no_feedback,
     "no_feedback",
     "",
     {0, 0},
     false,
     "the controller says nothing while the arm moves"},
    {RobotFault::nan_positions,
     "nan_positions",
     "",
     {0, 0},
     false,
     "one joint's position is no number"},
    {RobotFault::malformed,
     "malformed",
     "",
     {0, 0},
     false,
     "octets that are no messages, beside the joint states and images that are"},
    {RobotFault::wrong_names,
     "wrong_names",
     "",
     {0, 0},
     false,
     "the joint states are those of another robot"},
    {RobotFault::stale_stamps,
     "stale_stamps",
     "",
     {0, 0},
     false,
     "the stamps of all messages stand still"},
    {RobotFault::clock_offset,
     "clock_offset",
     "SECONDS",
     {5, 0},
     false,
     "the robot's clock is ahead by that"},
    {RobotFault::path_tolerance,
     "path_tolerance",
     "SHARE,TIMES",
     {0.5, 1},
     true,
     "the arm is held back until the controller aborts for the path's tolerance"},
    {RobotFault::goal_missed,
     "goal_missed",
     "RADIANS,TIMES",
     {0.05, 1},
     true,
     "the arm ends that far beside the goal, and the controller calls it a success"},
    {RobotFault::no_result,
     "no_result",
     "TIMES",
     {1, 0},
     true,
     "the arm arrives, and the controller never says so"},
    {RobotFault::frames_delayed,
     "frames_delayed",
     "SECONDS",
     {1, 0},
     false,
     "images come that much later, with the stamps they should have"},
    {RobotFault::hand_eye,
     "hand_eye",
     "MM,DEGREES",
     {20, 3},
     false,
     "the camera is mounted that far from where the robot's files say"},
    {RobotFault::time_offset,
     "time_offset",
     "SECONDS",
     {0.1, 0},
     false,
     "images are stamped later than they were taken, against the joint states"},
};

const FaultKind* fault_named(std::string_view name) {
  for (const FaultKind& kind : kFaultKinds) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::string fault_names() {
  std::string names;
  for (const FaultKind& kind : kFaultKinds)
    names += std::string(names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// How many values a kind takes, by the commas of what it says of them.
std::size_t value_count(const FaultKind& kind) {
  if (kind.values.empty()) return 0;
  return 1 + static_cast<std::size_t>(std::count(kind.values.begin(), kind.values.end(), ','));
}

Expected<std::array<double, 2>> read_values(const FaultKind& kind, std::string_view text) {
  std::array<double, 2> values = kind.defaults;
  for (std::size_t i = 0; !text.empty(); ++i) {
    const auto comma = text.find(',');
    if (i >= value_count(kind) || !read_number(text.substr(0, comma), values[i])) {
      return fail("fault '" + std::string(kind.name) + "': expected " +
                  (kind.values.empty() ? "no values" : std::string(kind.values)) + " behind ':'");
    }
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
  }
  return values;
}

}  // namespace

std::span<const FaultKind> fault_kinds() { return kFaultKinds; }

Expected<void> RobotFaults::set(std::string_view text) {
  const std::string whole(text);
  if (text == "none") {
    const std::scoped_lock lock(mutex_);
    switched_.clear();
    return {};
  }
  int from_motion = 0;
  if (const auto at = text.find('@'); at != std::string_view::npos) {
    if (!read_number(text.substr(at + 1), from_motion) || from_motion < 1) {
      return fail("fault '" + whole + "': expected the number of a motion, 1 or more, behind '@'");
    }
    text = text.substr(0, at);
  }
  const auto colon = text.find(':');
  const FaultKind* kind = fault_named(text.substr(0, colon));
  if (kind == nullptr) {
    return fail("fault '" + whole + "' is not known; there are: " + fault_names());
  }
  const std::string_view behind =
      colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  clear(kind->fault);
  if (behind == "off") return {};
  const auto values = read_values(*kind, behind);
  if (!values) return tl::unexpected(values.error());
  const std::scoped_lock lock(mutex_);
  switched_.push_back({kind, *values, from_motion, whole});
  return {};
}

void RobotFaults::clear(RobotFault fault) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(switched_, [&](const Switched& s) { return s.kind->fault == fault; });
}

void RobotFaults::begin_motion() {
  const std::scoped_lock lock(mutex_);
  ++motions_;
}

std::optional<std::array<double, 2>> RobotFaults::values_locked(RobotFault fault) const {
  for (const Switched& s : switched_) {
    if (s.kind->fault == fault && motions_ >= s.from_motion) return s.values;
  }
  return {};
}

std::optional<std::array<double, 2>> RobotFaults::values(RobotFault fault) const {
  const std::scoped_lock lock(mutex_);
  return values_locked(fault);
}

void RobotFaults::happened(RobotFault fault) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(switched_, [&](Switched& s) {
    if (s.kind->fault != fault || !s.kind->of_motion) return false;
    return --s.values[value_count(*s.kind) - 1] < 1;
  });
}

std::vector<std::string> RobotFaults::said() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> texts;
  for (const Switched& s : switched_) texts.push_back(s.text);
  return texts;
}

}  // namespace canopeer::ros
