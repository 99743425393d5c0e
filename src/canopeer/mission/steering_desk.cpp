#include "canopeer/mission/steering_desk.h"

#include <utility>

namespace canopeer {
void SteeringDesk::say(SteeringWord word) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (word.kind == SteeringWord::Kind::next_segment) {
    next_segment_ = std::move(word);
  } else if (word_.kind != SteeringWord::Kind::stop) {
    word_ = std::move(word);
  }
}

SteeringWord SteeringDesk::ask(const SteeringPoint& point) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!point.needs_person.empty() && word_.kind < SteeringWord::Kind::pause) {
    word_ = {SteeringWord::Kind::wait_for_person, "arm", std::string(point.needs_person)};
  }
  if (word_.kind != SteeringWord::Kind::go_on || !next_segment_) return word_;
  return *std::exchange(next_segment_, std::nullopt);
}

SteeringPolicy::SteeringPolicy(std::string name, Rule rule)
    : name_(std::move(name)), rule_(std::move(rule)) {}

SteeringWord SteeringPolicy::ask(const SteeringPoint& point) { return {rule_(point), name_, ""}; }

SteeringWord SteeringTogether::ask(const SteeringPoint& point) {
  using Kind = SteeringWord::Kind;
  SteeringWord strongest;
  for (Steering* const one : all_) {
    SteeringWord word = one->ask(point);
    if (word.kind == Kind::next_segment) next_segment_ = word;
    if (word.kind > strongest.kind) strongest = std::move(word);  // they are in this order
  }
  if (strongest.kind > Kind::next_segment || !next_segment_) return strongest;
  return *std::exchange(next_segment_, std::nullopt);
}

}  // namespace canopeer
