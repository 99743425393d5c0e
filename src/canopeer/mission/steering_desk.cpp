#include "canopeer/mission/steering_desk.h"

#include <algorithm>
#include <utility>

namespace canopeer {
void SteeringDesk::say(SteeringWord word) {
  const std::lock_guard<std::mutex> lock(mutex_);
  said_go_on_ = word.kind == SteeringWord::Kind::go_on;
  unread_ = true;
  if (word.kind == SteeringWord::Kind::next_segment) {
    next_segment_ = std::move(word);
  } else if (word_.kind != SteeringWord::Kind::stop) {
    word_ = std::move(word);
  }
}

bool SteeringDesk::unread() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return unread_;
}

SteeringWord SteeringDesk::ask(const SteeringPoint& point) {
  const std::lock_guard<std::mutex> lock(mutex_);
  unread_ = false;
  if (!point.needs_person.empty() && word_.kind < SteeringWord::Kind::pause) {
    word_ = {SteeringWord::Kind::wait_for_person, "arm", std::string(point.needs_person)};
  }
  if (word_.kind != SteeringWord::Kind::go_on || !next_segment_) return word_;
  return *std::exchange(next_segment_, std::nullopt);
}

bool SteeringDesk::person_said_go_on() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(said_go_on_, false);
}

SteeringPolicy::SteeringPolicy(std::string name, Rule rule)
    : name_(std::move(name)), rule_(std::move(rule)) {}

SteeringWord SteeringPolicy::ask(const SteeringPoint& point) { return {rule_(point), name_, ""}; }

SteeringWord SteeringTogether::ask(const SteeringPoint& point) {
  using Kind = SteeringWord::Kind;
  // Each of them would wait for its own person; one is enough.
  SteeringPoint plain = point;
  plain.needs_person = {};
  const bool said = person_said_go_on();
  if (!point.needs_person.empty() && reaches_person()) {
    waiting_ = {Kind::wait_for_person, "arm", std::string(point.needs_person)};
  } else if (said) {
    waiting_.reset();
  }
  SteeringWord strongest = waiting_.value_or(SteeringWord());
  for (Steering* const one : all_) {
    SteeringWord word = one->ask(plain);
    if (word.kind == Kind::next_segment) next_segment_ = word;
    if (word.kind > strongest.kind) strongest = std::move(word);  // they are in this order
  }
  if (strongest.kind > Kind::next_segment || !next_segment_) return strongest;
  return *std::exchange(next_segment_, std::nullopt);
}

bool SteeringTogether::reaches_person() const {
  return std::any_of(all_.begin(), all_.end(),
                     [](const Steering* one) { return one->reaches_person(); });
}

bool SteeringTogether::person_said_go_on() {
  bool said = false;
  for (Steering* const one : all_) said = one->person_said_go_on() || said;
  return said;
}

}  // namespace canopeer
