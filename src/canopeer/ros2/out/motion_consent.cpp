#include "canopeer/ros2/out/motion_consent.h"

namespace canopeer::ros {

bool MotionConsent::may(const std::string& what) {
  if (!asking()) return true;
  if (say_) say_("may I " + what + "? Call ~/confirm or ~/refuse");
  std::unique_lock lock(mutex_);
  if (!asking_) return true;
  question_ = what;
  answer_.reset();
  changed_.wait(lock, [&] { return answer_.has_value(); });
  question_.reset();
  return *answer_;
}

bool MotionConsent::answer(bool yes) {
  {
    const std::lock_guard lock(mutex_);
    if (!question_ || answer_) return false;
    answer_ = yes;
  }
  changed_.notify_all();
  return true;
}

std::optional<std::string> MotionConsent::question() const {
  const std::lock_guard lock(mutex_);
  return question_;
}

void MotionConsent::set_asking(bool ask) {
  {
    const std::lock_guard lock(mutex_);
    asking_ = ask;
  }
  if (!ask) answer(true);
}

bool MotionConsent::asking() const {
  const std::lock_guard lock(mutex_);
  return asking_;
}

void MotionConsent::close() { answer(false); }

}  // namespace canopeer::ros
