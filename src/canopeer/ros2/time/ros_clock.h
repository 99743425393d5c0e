#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "canopeer/dds/node.h"
#include "canopeer/mission/ports.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// Mission time and ROS time. On the wall mission time is steady and ROS time the system's; with
/// `use_sim_time` both come from /clock. Thread-safe.
class RosClock : public Clock {
 public:
  /// Where ROS time comes from on the wall; another one in tests.
  using SystemTime = std::function<Stamp()>;

  /// The wall's.
  explicit RosClock(SystemTime system = {});
  /// The simulation's: mission time begins when /clock is first heard.
  [[nodiscard]] static Expected<std::unique_ptr<RosClock>> of_simulation(Node& node);

  [[nodiscard]] double now_s() const override;
  void charge(double /*compute_s*/) override {}  // it has passed already
  /// Returns early when the simulation's time stops or jumps back: check() says so.
  void sleep(double seconds) override;

  /// ROS time now, for stamps of our own. 0: /clock was not heard yet.
  [[nodiscard]] Stamp now() const;
  /// Mission time of a stamp, s; before the mission it is negative.
  [[nodiscard]] double mission_time_s(Stamp stamp) const;
  /// It runs: always on the wall.
  [[nodiscard]] bool running() const;
  /// The error: time was set back, or /clock has stopped. Then nothing may go on.
  [[nodiscard]] Expected<void> check() const;

  /// What /clock says.
  void take(Stamp stamp);

 private:
  using Steady = std::chrono::steady_clock;
  struct Simulated {
    std::optional<Stamp> zero;
    Stamp now = 0;
    std::int64_t back = 0;  ///< by how much it jumped
    Steady::time_point heard;
  };

  SystemTime system_;
  const Steady::time_point begun_ = Steady::now();
  bool simulated_ = false;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Simulated simulation_;
  mutable std::int64_t ahead_ = 0;  ///< of the steady clock: the system's, at most so far
  Subscription subscription_;       // last: its callback uses all above
};

}  // namespace canopeer::ros
