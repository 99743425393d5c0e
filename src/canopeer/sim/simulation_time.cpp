#include "canopeer/sim/simulation_time.h"

#include <algorithm>
#include <thread>

namespace canopeer {

using SteadyClock = std::chrono::steady_clock;

SimulationTime::SimulationTime(bool realtime) : realtime_(realtime), zero_(SteadyClock::now()) {}

double SimulationTime::now_s() const {
  if (!realtime_) return simulated_s_;
  if (paused_) return paused_at_s_;
  return std::chrono::duration<double>(SteadyClock::now() - zero_).count();
}

void SimulationTime::charge(double seconds) {
  if (!realtime_) simulated_s_ += seconds;
}

void SimulationTime::pass_until(double time_s) {
  if (!realtime_) {
    simulated_s_ = std::max(simulated_s_, time_s);
    return;
  }
  const double left_s = time_s - now_s();
  if (left_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(left_s));
}

SimulationTime::Pause::Pause(SimulationTime& time) : time_(time), begin_(SteadyClock::now()) {
  time_.paused_at_s_ = time_.now_s();
  time_.paused_ = true;
}

SimulationTime::Pause::~Pause() {
  time_.zero_ += SteadyClock::now() - begin_;
  time_.paused_ = false;
}

}  // namespace canopeer
