#include "canopeer/ros2/time/ros_clock.h"

#include <algorithm>
#include <thread>

#include "canopeer/cdr/messages/rosgraph_msgs.h"
#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

// Simulations say the time a thousand times a second to once in a tenth; paused ones not at all.
constexpr std::chrono::seconds kClockSilence(10);
constexpr std::int64_t kSetBack = kNanosecondsPerSecond / 2;  // less may be a clock that is steered
constexpr std::int64_t kOvertaken = kNanosecondsPerSecond / 10;  // by another message

Stamp system_time() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::int64_t count(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

std::string seconds_text(std::int64_t ns) { return figure(seconds(ns), 1) + " s"; }

}  // namespace

RosClock::RosClock(SystemTime system) : system_(system ? std::move(system) : system_time) {
  ahead_ = system_() - count(Steady::now() - begun_);
}

Expected<std::unique_ptr<RosClock>> RosClock::of_simulation(Node& node) {
  auto clock = std::make_unique<RosClock>();
  clock->simulated_ = true;
  auto subscription = node.subscribe<rosgraph_msgs::Clock>(
      "/clock", Qos{false, false, 10}, [raw = clock.get()](const auto& message, const Guid&) {
        raw->take(stamp_of(message.clock));
      });
  if (!subscription) return fail_in("/clock", subscription.error());
  clock->subscription_ = std::move(*subscription);
  return clock;
}

void RosClock::take(Stamp stamp) {
  const std::lock_guard lock(mutex_);
  simulation_.heard = Steady::now();
  if (!simulation_.zero) simulation_.zero = simulation_.now = stamp;
  if (simulation_.now - stamp > kOvertaken) {
    simulation_.back = std::max(simulation_.back, simulation_.now - stamp);
  }
  simulation_.now = std::max(simulation_.now, stamp);
  changed_.notify_all();
}

bool RosClock::running() const {
  const std::lock_guard lock(mutex_);
  return !simulated_ || simulation_.zero.has_value();
}

double RosClock::now_s() const {
  if (!simulated_) return seconds(count(Steady::now() - begun_));
  const std::lock_guard lock(mutex_);
  return simulation_.zero ? seconds(simulation_.now - *simulation_.zero) : 0.0;
}

Stamp RosClock::now() const {
  if (!simulated_) return system_();
  const std::lock_guard lock(mutex_);
  return simulation_.now;
}

double RosClock::mission_time_s(Stamp stamp) const {
  if (!simulated_) return now_s() - seconds(system_() - stamp);
  const std::lock_guard lock(mutex_);
  return seconds(stamp - simulation_.zero.value_or(stamp));
}

void RosClock::sleep(double wanted_s) {
  if (wanted_s <= 0.0) return;
  if (!simulated_) {
    std::this_thread::sleep_for(std::chrono::duration<double>(wanted_s));
    return;
  }
  std::unique_lock lock(mutex_);
  const Stamp end = simulation_.now + nanoseconds(wanted_s);
  while (simulation_.now < end && simulation_.back == 0) {
    if (changed_.wait_for(lock, kClockSilence) == std::cv_status::timeout) return;
  }
}

Expected<void> RosClock::check() const {
  const std::lock_guard lock(mutex_);
  if (!simulated_) {
    const std::int64_t ahead = system_() - count(Steady::now() - begun_);
    const std::int64_t back = ahead_ - ahead;
    ahead_ = std::max(ahead_, ahead);
    if (back < kSetBack) return {};
    return fail("the system's time was set back by " + seconds_text(back) +
                " during the mission, so stamps mean nothing any more; start it anew");
  }
  if (simulation_.back > 0) {
    return fail("/clock jumped back by " + seconds_text(simulation_.back) +
                ": the simulation was reset or there are two; start the mission anew");
  }
  if (simulation_.zero && Steady::now() - simulation_.heard < kClockSilence) return {};
  return fail("/clock is silent: the simulation has stopped or is paused (ros2.use_sim_time)");
}

}  // namespace canopeer::ros
