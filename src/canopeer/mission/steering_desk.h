#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "canopeer/mission/steering.h"

namespace canopeer {

/// Takes words from other threads: a page, a service, a keyboard. `pause` and `wait_for_person`
/// hold until `go_on` or another of them comes, `stop` stays. `next_segment` is handed over once,
/// after a hold if there is one. When the arm needs a person it waits for one. Thread-safe.
class SteeringDesk : public Steering {
 public:
  void say(SteeringWord word);
  /// Whether something was said that was not asked for yet.
  [[nodiscard]] bool unread() const;
  [[nodiscard]] SteeringWord ask(const SteeringPoint& point) override;
  [[nodiscard]] bool reaches_person() const override { return true; }
  [[nodiscard]] bool person_said_go_on() override;

 private:
  mutable std::mutex mutex_;
  SteeringWord word_;  // all but next_segment
  bool said_go_on_ = false;
  bool unread_ = false;
  std::optional<SteeringWord> next_segment_;
};

/// A rule in place of a person, e.g. "stop after 100 views": what `rule` answers.
class SteeringPolicy : public Steering {
 public:
  using Rule = std::function<SteeringWord::Kind(const SteeringPoint&)>;
  SteeringPolicy(std::string name, Rule rule);
  [[nodiscard]] SteeringWord ask(const SteeringPoint& point) override;

 private:
  std::string name_;
  Rule rule_;
};

/// Several at once; the word that stops most counts: stop, wait_for_person, pause, next_segment,
/// go_on. Among equals the first. A next_segment said during another's hold counts after it. When
/// the arm needs a person, any person among them may say go_on.
class SteeringTogether : public Steering {
 public:
  /// `steering` outlives it.
  void add(Steering& steering) { all_.push_back(&steering); }
  [[nodiscard]] SteeringWord ask(const SteeringPoint& point) override;
  [[nodiscard]] bool reaches_person() const override;
  [[nodiscard]] bool person_said_go_on() override;

 private:
  std::vector<Steering*> all_;
  std::optional<SteeringWord> waiting_;       // for a person
  std::optional<SteeringWord> next_segment_;  // said during a hold
};

}  // namespace canopeer
