#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "canopeer/mission/ports.h"
#include "canopeer/planner/planner.h"

namespace canopeer {

/// What the planner does while the arm moves and the search runs. In simulated time (no workers)
/// the work is done in the call that says how much time has passed, worth that time by the cost
/// table. On the wall clock worker threads make the planner's tasks all the time, while frames are
/// fused too: tasks read a snapshot of the map, and what they find is taken over between two calls
/// of the planner.
class Background {
 public:
  /// All outlive it. `work`: what is done is counted there.
  Background(Planner& planner, const Clock& clock, int workers, WorkMeter& work);
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Tasks run in other threads, so they must be given snapshots.
  [[nodiscard]] bool has_workers() const { return !workers_.empty(); }

  /// Tasks may be made from now on, when a segment has begun …
  void go() { set_quiet(false); }
  /// … until now: what the planner was told of the segment is about to go.
  void rest() { static_cast<void>(stop_tasks()); }

  /// The mission holds: no task is under way until resume(). The time that passes meanwhile is not
  /// told.
  void hold() { quiet_before_hold_ = stop_tasks(); }
  void resume();

  /// So much mission time goes by: a motion, computing, waiting. On the wall clock the time that
  /// really went by is what the planner is told. While it rests it is told nothing.
  void time_passes(double seconds);

  /// Calls `f(planner)`; workers go on with the tasks they have.
  template <typename F>
  decltype(auto) beside(F&& f) {
    const std::lock_guard<std::mutex> lock(planner_mutex_);
    return std::forward<F>(f)(planner_);
  }

  /// Calls `f(planner)`, which may change what tasks read beside their snapshot (the segment); no
  /// task is under way meanwhile.
  template <typename F>
  decltype(auto) alone(F&& f) {
    const Quiet quiet(*this);
    return beside(std::forward<F>(f));
  }

 private:
  struct Quiet {
    explicit Quiet(Background& b) : background(b), before(b.stop_tasks()) {}
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
    ~Quiet() { background.set_quiet(before); }
    Background& background;
    bool before;
  };
  /// Waits until no task is under way; returns whether that was so for good already.
  bool stop_tasks();
  void set_quiet(bool quiet);
  void work_until_told(const std::stop_token& stop);
  /// False: there was nothing to do.
  bool make_one_task();

  Planner& planner_;
  const Clock& clock_;
  WorkMeter& work_;
  double told_s_ = 0.0;
  bool quiet_before_hold_ = true;
  std::mutex planner_mutex_;
  std::mutex state_mutex_;  // of what follows
  std::condition_variable_any changed_;
  bool quiet_ = true;
  int under_way_ = 0;
  std::vector<std::jthread> workers_;  // last, so that they end first
};

}  // namespace canopeer
