#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer::ros {

/// What can go wrong with the simulated robot, on request.
enum class RobotFault {
  reject,
  abort,
  preempt,
  protective_stop,
  slow,
  vanish,
  joint_states_silent,
  camera_silent,
  no_feedback,
  nan_positions,
  malformed,
  wrong_names,
  stale_stamps,
  clock_offset,
  path_tolerance,
  goal_missed,
  no_result,
  frames_delayed,
  hand_eye,
  time_offset
};

/// A fault, as people name it.
struct FaultKind {
  RobotFault fault;
  std::string_view name;
  std::string_view values;  ///< what may stand behind the colon; empty: nothing
  std::array<double, 2> defaults;
  bool of_motion;  ///< happens to so many motions (the last value), then it is over
  std::string_view what;
};

/// All there are.
[[nodiscard]] std::span<const FaultKind> fault_kinds();

/// Which faults are on. Thread-safe.
class RobotFaults {
 public:
  /// "NAME", "NAME:VALUE", "NAME:VALUE,VALUE": on. "…@N": from the N-th motion of the arm on (1, 2,
  /// …). "NAME:off": off. "none": all off. The error lists the names there are.
  [[nodiscard]] Expected<void> set(std::string_view text);
  void clear(RobotFault fault);

  /// The arm was given one more motion.
  void begin_motion();
  /// The values of a fault that is on; none: it is off.
  [[nodiscard]] std::optional<std::array<double, 2>> values(RobotFault fault) const;
  [[nodiscard]] bool on(RobotFault fault) const { return values(fault).has_value(); }
  /// A fault of motions has happened once more.
  void happened(RobotFault fault);
  /// What is on or to come, as set() takes it.
  [[nodiscard]] std::vector<std::string> said() const;

 private:
  struct Switched {
    const FaultKind* kind;
    std::array<double, 2> values;
    int from_motion;
    std::string text;
  };
  [[nodiscard]] std::optional<std::array<double, 2>> values_locked(RobotFault fault) const;

  mutable std::mutex mutex_;
  std::vector<Switched> switched_;
  int motions_ = 0;
};

}  // namespace canopeer::ros
