#include "canopeer/mission/segment/background.h"

#include <chrono>
#include <memory>
#include <utility>

namespace canopeer {

Background::Background(Planner& planner, const Clock& clock, int workers, WorkMeter& work)
    : planner_(planner), clock_(clock), work_(work), told_s_(clock.now_s()) {
  for (int i = 0; i < workers; ++i) {
    workers_.emplace_back([this](const std::stop_token& stop) { work_until_told(stop); });
  }
}

Background::~Background() {
  for (auto& worker : workers_) worker.request_stop();
  changed_.notify_all();
}

void Background::resume() {
  told_s_ = clock_.now_s();
  set_quiet(quiet_before_hold_);
}

void Background::time_passes(double seconds) {
  if (workers_.empty()) {
    if (!quiet_) planner_.grow(seconds, work_);
    return;
  }
  const double now_s = clock_.now_s();
  beside([&](Planner& planner) { planner.time_passes(now_s - told_s_); });
  told_s_ = now_s;
}

bool Background::stop_tasks() {
  std::unique_lock lock(state_mutex_);
  const bool before = std::exchange(quiet_, true);
  changed_.wait(lock, [this] { return under_way_ == 0; });
  return before;
}

void Background::set_quiet(bool quiet) {
  {
    const std::lock_guard<std::mutex> lock(state_mutex_);
    quiet_ = quiet;
  }
  changed_.notify_all();
}

void Background::work_until_told(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kNothingToDo(5);
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(state_mutex_);
      if (!changed_.wait(lock, stop, [this] { return !quiet_; })) return;
      ++under_way_;
    }
    const bool worked = make_one_task();
    {
      std::unique_lock lock(state_mutex_);
      --under_way_;
      changed_.notify_all();
      if (!worked) changed_.wait_for(lock, stop, kNothingToDo, [] { return false; });
    }
  }
}

bool Background::make_one_task() {
  const auto task = beside([](Planner& planner) { return planner.next_task(); });
  if (!task) return false;
  task->run();
  beside([&](Planner& planner) { planner.finish_task(*task, work_); });
  return true;
}

}  // namespace canopeer
