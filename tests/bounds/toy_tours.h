#pragma once

#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/bounds/tours/tour_views.h"

namespace canopeer::test {

/// Views are points of a plane, motions take as long as they are far, some are not free.
class ToyMotions : public TourMotions {
 public:
  std::vector<std::vector<std::pair<double, double>>> points;  ///< by segment and view
  std::set<std::tuple<int, int, int>> blocked;
  std::set<std::tuple<int, int, int>> known_blocked;

  double time_s(int segment, int from, int to) override {
    if (known_blocked.count({segment, from, to}) > 0) {
      return std::numeric_limits<double>::infinity();
    }
    return distance(segment, from, to);
  }
  bool free(int segment, int from, int to) override {
    if (blocked.count({segment, from, to}) == 0) return true;
    known_blocked.insert({segment, from, to});
    return false;
  }
  double transition_s(int segment, int from) override { return 0.5 + distance(segment, from, 0); }

 private:
  [[nodiscard]] double distance(int segment, int from, int to) const {
    const auto& place = points[static_cast<std::size_t>(segment)];
    const auto [ax, ay] = place[static_cast<std::size_t>(from)];
    const auto [bx, by] = place[static_cast<std::size_t>(to)];
    return std::hypot(ax - bx, ay - by);
  }
};

/// A toy problem and what it points to.
struct Toy {
  ToyMotions motions;
  TourProblem problem;
};

/// `views` a segment, that at home included; fruits of 4 patches of 1 cm².
inline void make_toy(Toy& toy, std::uint64_t seed, int segments, int views, int fruits) {
  Rng rng(seed, "toy tours");
  std::vector<int> fruit_of;
  for (int f = 0; f < fruits; ++f) fruit_of.insert(fruit_of.end(), 4, f);
  toy.problem = {};
  toy.problem.patch_cm2.assign(fruit_of.size(), 1.0F);
  toy.problem.fruits = fruits;
  toy.problem.fruits_total = fruits + 1;
  toy.problem.min_area_cm2.assign(static_cast<std::size_t>(fruits), 2.0);
  toy.problem.motions = &toy.motions;
  for (int s = 0; s < segments; ++s) {
    auto& shown = toy.problem.segments.emplace_back();
    auto& places = toy.motions.points.emplace_back();
    for (int v = 0; v < views; ++v) {
      places.push_back({rng.uniform(0.0, 2.0), rng.uniform(0.0, 2.0)});
      std::vector<std::uint32_t> patches;
      const double share = v == 0 ? 0.05 : 0.3;
      for (std::uint32_t patch = 0; patch < fruit_of.size(); ++patch) {
        if (rng.uniform() < share) patches.push_back(patch);
      }
      shown.push_back(make_tour_view(patches, fruit_of, toy.problem.patch_cm2));
      for (int other = 0; other < views; ++other) {
        if (other != v && rng.uniform() < 0.15) toy.motions.blocked.insert({s, v, other});
      }
    }
    toy.problem.clock.budget_s.push_back(rng.uniform(1.5, 4.0));
  }
  toy.problem.clock.observe_s = 0.1;
  toy.problem.clock.leave_when_done = rng.uniform() < 0.3;
  if (rng.uniform() < 0.4) {  // the clock that never stops
    double t_s = 0.0;
    for (const double budget_s : toy.problem.clock.budget_s) {
      t_s += budget_s + (t_s > 0.0 ? 0.8 : 0.0);
      toy.problem.clock.deadline_s.push_back(t_s);
    }
  }
  if (rng.uniform() < 0.3) {
    toy.problem.clock.max_views.assign(static_cast<std::size_t>(segments),
                                       2 + static_cast<int>(rng.index(3)));
  }
  toy.problem.horizon_s = 10.0;
  const bool auc = rng.uniform() < 0.5;
  toy.problem.ever = auc ? 0.02 : 1.0;
  toy.problem.early = auc ? 1.0 : 0.02;
}

}  // namespace canopeer::test
