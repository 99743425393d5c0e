#pragma once

#include "canopeer/planner/planner.h"

namespace canopeer {

/// For planners that have found no view: wait, until that has gone on for too long.
class Patience {
 public:
  explicit Patience(double max_wait_s = 3.0) : max_wait_s_(max_wait_s) {}

  void time_passes(double seconds) { waited_s_ += seconds; }
  /// A view was found.
  void renew() { waited_s_ = 0.0; }
  [[nodiscard]] Decision hold() const {
    Decision decision;
    decision.action = waited_s_ > max_wait_s_ ? Decision::Action::stuck : Decision::Action::wait;
    return decision;
  }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(waited_s_);
  }

 private:
  double max_wait_s_;
  double waited_s_ = 0.0;
};

}  // namespace canopeer
