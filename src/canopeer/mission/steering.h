#pragma once

#include <string>
#include <string_view>

namespace canopeer {

/// What the mission should do next, and who says so.
struct SteeringWord {
  enum class Kind {
    go_on,
    next_segment,     ///< end this segment now: home, and on
    pause,            ///< do nothing until told otherwise; a hold is not counted as segment time
    wait_for_person,  ///< the same, because a person has something to do first: `why`
    stop              ///< end the run: the arm goes home, results so far are written
  };
  Kind kind = Kind::go_on;
  std::string by;   ///< "signal", "page", a policy's name
  std::string why;  ///< for people; may be empty
};

/// "go_on", "pause", "wait_for_person", "next_segment", "stop".
[[nodiscard]] std::string_view steering_name(SteeringWord::Kind kind);

/// Where the mission stands between two steps.
struct SteeringPoint {
  double t_s = 0.0;             ///< mission time
  int segment = 0;              ///< 0 …
  double segment_time_s = 0.0;  ///< since the last segment began
  std::string_view next;        ///< "drive", "begin", "decide", "go_home"
  int views = 0;                ///< so far
  int fruits = 0;               ///< known now
  bool holding = false;         ///< paused or waiting; asked again and again
  /// The arm stopped in a way that a person has to look at, and why; said at one question. Who
  /// reaches a person answers wait_for_person until that person says go_on.
  std::string_view needs_person{};
};

/// The one input by which people, signals, policies and services steer a mission. Asked in the
/// mission's thread before every step, many times while it holds; simulated time stands still then.
/// The same answers at the same points give the same run.
class Steering {
 public:
  virtual ~Steering() = default;
  [[nodiscard]] virtual SteeringWord ask(const SteeringPoint& point) = 0;
  /// Whether a person may say something here.
  [[nodiscard]] virtual bool reaches_person() const { return false; }
  /// Whether a person has said to go on since this was asked last.
  [[nodiscard]] virtual bool person_said_go_on() { return false; }
};

}  // namespace canopeer
