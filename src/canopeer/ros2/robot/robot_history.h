#pragma once

#include <deque>
#include <mutex>
#include <optional>

#include "canopeer/robot/robot_model.h"
#include "canopeer/ros2/robot/robot_clock.h"

namespace canopeer::ros {

/// Where the simulated robot is.
struct SimulatedPlace {
  Configuration q;
  TrolleyState trolley;
};

/// Where it was in the last seconds. Thread-safe.
class RobotHistory {
 public:
  /// Times rise.
  void add(Stamp time, const SimulatedPlace& place);
  /// Where it was at `time`; none: that is not known yet, or no more.
  [[nodiscard]] std::optional<SimulatedPlace> at(Stamp time) const;

 private:
  struct Entry {
    Stamp time;
    SimulatedPlace place;
  };
  mutable std::mutex mutex_;
  std::deque<Entry> entries_;
};

}  // namespace canopeer::ros
