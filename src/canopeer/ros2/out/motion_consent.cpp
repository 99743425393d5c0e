#include "canopeer/ros2/out/motion_consent.h"

#include <chrono>

namespace canopeer::ros {

bool MotionConsent::may(const std::string& what, const std::function<bool()>& given_up) {
  if (!asking()) return true;
  if (say_) say_("may I " + what + "? Call ~/confirm or ~/refuse");
  std::unique_lock lock(mutex_);
  if (!asking_) return true;
  question_ = what;
  answer_.reset();
  while (!answer_ && !given_up()) changed_.wait_for(lock, std::chrono::milliseconds(20));
  question_.reset();
  return answer_.value_or(false);
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

}  // namespace canopeer::ros
