#pragma once

#include <string>
#include <vector>

#include "canopeer/record/yardstick.h"

namespace canopeer {

/// A bound B(t) on fruits by time, from bounds of several kinds: a step function. It never falls,
/// and all of it holds at every t up to its end.
class BoundCourse {
 public:
  /// `earliest_s`: by fruit, when it can be found at the earliest; infinite: never. `by`: the name
  /// of that bound.
  BoundCourse(std::vector<double> earliest_s, std::string by);

  /// At `t_s` there are no more than so many fruits, hence at no time before; rounded down to a
  /// whole number. Times never fall.
  void limit(double t_s, double fruits, const std::string& by);

  /// `fruits_total`: N. `end_s`: T; infinite: any.
  [[nodiscard]] UpperBound result(int fruits_total, double end_s) const;

 private:
  struct Limit {
    double t_s = 0.0;
    double fruits = 0.0;
    std::string by;
  };
  std::vector<double> earliest_s_;  // ascending, finite ones
  std::string by_;
  std::vector<Limit> limits_;  // by time
};

}  // namespace canopeer
