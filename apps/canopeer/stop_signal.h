#pragma once

#include <atomic>

#include "canopeer/mission/steering.h"

namespace canopeer::app {

/// Set by the first Ctrl-C (SIGINT) or SIGTERM: finish what is under way, write the results, end. A
/// second one ends the program at once.
std::atomic<bool>& catch_stop_signals();

/// Steers a mission by these signals.
class SignalSteering : public Steering {
 public:
  SignalSteering() : stop_(catch_stop_signals()) {}
  [[nodiscard]] SteeringWord ask(const SteeringPoint& /*point*/) override {
    if (!stop_) return {};
    return {SteeringWord::Kind::stop, "signal", "interrupted from outside"};
  }

 private:
  const std::atomic<bool>& stop_;
};

}  // namespace canopeer::app
