#include "canopeer/ros2/robot/motion_watch.h"

#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>
#include <unistd.h>

namespace canopeer::ros {
namespace {

/// States closer than this, Σ|Δq|, are one; the judge looks between them as finely as it needs.
constexpr double kApart = 0.002;

}  // namespace

MotionWatch::MotionWatch(const MotionJudge& judge)
    : judge_(judge), worker_([this](std::stop_token stop) { work(std::move(stop)); }) {}

MotionWatch::~MotionWatch() = default;

void MotionWatch::see(const SimulatedPlace& place, bool standing) {
  if (under_way_.empty() || joint_distance(under_way_.back(), place.q) > kApart) {
    under_way_.push_back(place.q);
  }
  if (!standing || under_way_.size() < 2) return;
  under_way_.push_back(place.q);
  {
    const std::scoped_lock lock(mutex_);
    to_judge_.push_back({std::move(under_way_), place.trolley});
  }
  changed_.notify_all();
  under_way_ = {place.q};
}

MotionWatch::Counts MotionWatch::counts() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return to_judge_.empty() && !judging_; });
  return counts_;
}

void MotionWatch::work(std::stop_token stop) {
  // Whoever plans and moves comes first: Linux gives each thread a priority of its own.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10));
  tbb::task_arena one_thread(1);
  while (true) {
    std::vector<Motion> motions;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [&] { return !to_judge_.empty(); })) return;
      motions.swap(to_judge_);
      judging_ = true;
    }
    for (const Motion& motion : motions) {
      const Verdict verdict =
          one_thread.execute([&] { return judge_.judge(motion.states, motion.trolley, nullptr); });
      const std::scoped_lock lock(mutex_);
      ++counts_.motions;
      counts_.collisions += verdict.collision ? 1 : 0;
      counts_.plant_contacts += verdict.plant_contact ? 1 : 0;
    }
    {
      const std::scoped_lock lock(mutex_);
      judging_ = false;
    }
    changed_.notify_all();
  }
}

}  // namespace canopeer::ros
