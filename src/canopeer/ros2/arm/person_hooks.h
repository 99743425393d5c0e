#pragma once

#include <functional>
#include <string>

namespace canopeer::ros {

/// What a person may say while the robot moves, and what is said to people. All may be empty.
struct PersonHooks {
  /// A person wants the run to stop: what is under way ends. Once true it may stay so.
  std::function<bool()> stop_asked;
  /// Asks whether a motion, described in one line, may be; waits for the answer. Empty: it may.
  std::function<bool(const std::string& motion)> may_move;
  /// Tells people what they should know or do.
  std::function<void(const std::string& text)> say;

  [[nodiscard]] bool stop() const { return stop_asked && stop_asked(); }
  void tell(const std::string& text) const {
    if (say) say(text);
  }
};

}  // namespace canopeer::ros
