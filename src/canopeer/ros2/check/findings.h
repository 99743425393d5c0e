#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/ros2/ros2_check.h"

namespace canopeer::ros {

/// Collects findings and hands each on at once.
class Findings {
 public:
  using Verdict = Ros2Finding::Verdict;

  explicit Findings(std::function<void(const Ros2Finding&)> on_finding = {})
      : on_finding_(std::move(on_finding)) {}

  void ok(std::string what, std::string text) { add(Verdict::ok, what, text); }
  void notice(std::string what, std::string text) { add(Verdict::notice, what, text); }
  void wrong(std::string what, std::string text) { add(Verdict::wrong, what, text); }

  [[nodiscard]] bool any_wrong() const {
    for (const Ros2Finding& finding : all_) {
      if (finding.verdict == Verdict::wrong) return true;
    }
    return false;
  }
  [[nodiscard]] const std::vector<Ros2Finding>& all() const { return all_; }

 private:
  void add(Verdict verdict, std::string& what, std::string& text) {
    all_.push_back({verdict, std::move(what), std::move(text)});
    if (on_finding_) on_finding_(all_.back());
  }
  std::function<void(const Ros2Finding&)> on_finding_;
  std::vector<Ros2Finding> all_;
};

}  // namespace canopeer::ros
