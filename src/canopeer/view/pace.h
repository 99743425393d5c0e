#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <utility>

#include "canopeer/mission/steering.h"

namespace canopeer {

/// Holds a mission in simulated time back to so many mission seconds a second, by answering late.
/// It changes nothing of the run. Thread-safe.
class Pace : public Steering {
 public:
  /// `give_up`: asked while it holds; true ends that, for a mission that is to stop.
  explicit Pace(std::function<bool()> give_up) : give_up_(std::move(give_up)) {}
  /// 0: as fast as it goes. Counts from now on.
  void set(double factor);
  [[nodiscard]] SteeringWord ask(const SteeringPoint& point) override;

 private:
  using Time = std::chrono::steady_clock::time_point;
  /// How long the mission is ahead, s.
  [[nodiscard]] double ahead_s(double t_s);

  std::function<bool()> give_up_;
  std::mutex mutex_;
  double factor_ = 0.0;
  bool fresh_ = true;
  double from_s_ = 0.0;  // mission time at `from_`
  Time from_;
};

}  // namespace canopeer
