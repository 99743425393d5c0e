#include "canopeer/bounds/limits/bound_course.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr double kWhole = 1e-6;  // fruits: what sums of doubles may be out by, with room

}  // namespace

BoundCourse::BoundCourse(std::vector<double> earliest_s, std::string by) : by_(std::move(by)) {
  std::copy_if(earliest_s.begin(), earliest_s.end(), std::back_inserter(earliest_s_),
               [](double t_s) { return std::isfinite(t_s); });
  std::sort(earliest_s_.begin(), earliest_s_.end());
}

void BoundCourse::limit(double t_s, double fruits, const std::string& by) {
  CANOPEER_CHECK(limits_.empty() || limits_.back().t_s <= t_s, "limits come by time");
  limits_.push_back({t_s, std::floor(std::max(0.0, fruits) + kWhole), by});
}

UpperBound BoundCourse::result(int fruits_total, double end_s) const {
  // Whoever has no more at a later time has no more now.
  std::vector<Limit> limits = limits_;
  for (std::size_t i = limits.size(); i-- > 1;) {
    if (limits[i].fruits < limits[i - 1].fruits) {
      limits[i - 1].fruits = limits[i].fruits;
      limits[i - 1].by = limits[i].by;
    }
  }
  std::vector<double> steps_s = {0.0};
  for (const double t_s : earliest_s_) steps_s.push_back(t_s);
  for (const Limit& limit : limits) steps_s.push_back(limit.t_s);
  std::sort(steps_s.begin(), steps_s.end());
  steps_s.erase(std::unique(steps_s.begin(), steps_s.end()), steps_s.end());
  std::erase_if(steps_s, [&](double t_s) { return t_s > end_s; });

  UpperBound bound;
  bound.by = by_;
  double area = 0.0;
  for (std::size_t i = 0; i < steps_s.size(); ++i) {
    // On [t, next): limits that lie behind t hold.
    const double t_s = steps_s[i];
    double fruits = static_cast<double>(
        std::upper_bound(earliest_s_.begin(), earliest_s_.end(), t_s) - earliest_s_.begin());
    bound.by = by_;
    const auto ahead =
        std::find_if(limits.begin(), limits.end(), [&](const Limit& l) { return l.t_s > t_s; });
    const bool last = ahead == limits.end();
    if (!limits.empty() && (!last || limits.back().t_s >= t_s)) {
      const Limit& limit = last ? limits.back() : *ahead;
      if (limit.fruits < fruits) {
        fruits = limit.fruits;
        bound.by = limit.by;
      }
    }
    if (bound.course.empty() || bound.course.back().fruits != fruits) {
      bound.course.push_back({t_s, fruits});
    }
    const double next_s = i + 1 < steps_s.size() ? steps_s[i + 1] : end_s;
    if (std::isfinite(next_s)) area += (next_s - t_s) * fruits;
  }
  bound.fruits = bound.course.back().fruits;
  if (fruits_total > 0) {
    // The mean of what never falls grows with T.
    bound.auc = std::isfinite(end_s) && end_s > 0.0 ? area / (end_s * fruits_total)
                                                    : *bound.fruits / fruits_total;
  }
  return bound;
}

}  // namespace canopeer
