#pragma once

#include <functional>
#include <string>

namespace canopeer::ros {

/// What a person may say while the robot moves, and what is said to people. All may be empty.
struct PersonHooks {
  /// A person wants the run to stop. Once true it stays so.
  std::function<bool()> stop_asked;
  /// The mission knows that and brings the arm home: the arm may move for it. Empty: it never does.
  std::function<bool()> going_home;
  /// Not even home: the person said it a second time. Empty: none does.
  std::function<bool()> stop_at_once;
  /// Asks whether a motion, described in one line, may be; waits for the answer. Empty: it may.
  std::function<bool(const std::string& motion)> may_move;
  /// Tells people what they should know or do.
  std::function<void(const std::string& text)> say;

  [[nodiscard]] bool stop() const { return (stop_asked && stop_asked()) || at_once(); }
  [[nodiscard]] bool at_once() const { return stop_at_once && stop_at_once(); }
  /// What the arm does ends, or does not begin.
  [[nodiscard]] bool arm_stops() const {
    return at_once() || (stop() && !(going_home && going_home()));
  }
  void tell(const std::string& text) const {
    if (say) say(text);
  }
};

}  // namespace canopeer::ros
