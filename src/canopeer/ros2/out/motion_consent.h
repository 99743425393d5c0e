#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace canopeer::ros {

/// Asks a person before something moves, if asking is switched on. Thread-safe.
class MotionConsent {
 public:
  /// `say` tells people what is asked.
  MotionConsent(bool ask, std::function<void(const std::string& question)> say)
      : asking_(ask), say_(std::move(say)) {}

  /// Whether that may be; waits for the answer. True at once when nobody is to be asked; false when
  /// `given_up` is before the answer comes.
  [[nodiscard]] bool may(const std::string& what, const std::function<bool()>& given_up);
  /// The answer to what is asked now; false: nothing is.
  bool answer(bool yes);
  /// What is asked now.
  [[nodiscard]] std::optional<std::string> question() const;

  /// Whether people are asked from now on. Switched off: what is asked now may be.
  void set_asking(bool ask);
  [[nodiscard]] bool asking() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool asking_;
  std::function<void(const std::string&)> say_;
  std::optional<std::string> question_;
  std::optional<bool> answer_;
};

}  // namespace canopeer::ros
