#pragma once

#include <atomic>

#include "canopeer/mission/steering.h"

namespace canopeer::app {

/// Set by the first Ctrl-C (SIGINT), SIGTERM or, where it is not ignored, SIGHUP: finish what is
/// under way, write the results, end. A second one ends the program at once. SIGPIPE is ignored:
/// who reads what is said is gone, and the work goes on.
const std::atomic<bool>& catch_stop_signals();

/// Set by the second one, which does not end the program from now on; a third does. For what must
/// not be left moving.
const std::atomic<bool>& catch_second_stop();

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
