#include "canopeer/planner/gomvp/warm_start.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace canopeer {
namespace {

constexpr double kLess = 1e-9;      // what counts as cheaper
constexpr int kMaxRounds = 50;      // of improvements
constexpr std::size_t kMaxRow = 3;  // views that or-opt moves together

/// A path that grows, and how many of its views see each target.
class GrowingPath {
 public:
  GrowingPath(const InspectionProblem& problem, InspectionPath path)
      : problem_(&problem),
        path_(std::move(path)),
        targets_of_(static_cast<std::size_t>(problem.views())),
        seen_(problem.seen_by.size(), 0) {
    for (std::size_t j = 0; j < problem.seen_by.size(); ++j) {
      for (const int view : problem.seen_by[j]) targets_of(view).push_back(j);
    }
    for (const int view : path_) count(view, 1);
  }

  [[nodiscard]] const InspectionPath& path() const { return path_; }

  /// One view more; false: none shows anything new within the budget.
  bool grow() {
    std::optional<Insertion> best;
    const double left_s = budget_s() - path_time_s(*problem_, path_);
    for (int view = 0; view < problem_->views(); ++view) {
      const double gain = new_weight(view);
      if (gain <= 0.0) continue;
      Insertion way = cheapest(view);
      if (way.more_s > left_s) continue;
      way.rate = gain / std::max(way.more_s, 1e-6);
      if (!best || way.rate > best->rate) best = way;
    }
    if (!best) return false;
    path_.insert(path_.begin() + static_cast<std::ptrdiff_t>(best->place), best->view);
    count(best->view, 1);
    return true;
  }

  /// Takes out views whose targets are all seen by others, each time the one that saves most.
  void drop_idle() {
    while (true) {
      std::size_t best = path_.size();
      double most_s = -1.0;
      for (std::size_t i = 0; i < path_.size(); ++i) {
        const auto& targets = targets_of(path_[i]);
        const bool idle =
            std::all_of(targets.begin(), targets.end(), [&](auto j) { return seen_[j] > 1; });
        const double saved_s = idle ? saved_without(i) : -1.0;
        if (!idle || saved_s <= most_s) continue;
        best = i;
        most_s = saved_s;
      }
      if (best == path_.size()) return;
      count(path_[best], -1);
      path_.erase(path_.begin() + static_cast<std::ptrdiff_t>(best));
    }
  }

 private:
  struct Insertion {
    int view = 0;
    std::size_t place = 0;
    double more_s = 0.0;
    double rate = 0.0;
  };

  [[nodiscard]] double budget_s() const {
    return problem_->objective == InspectionProblem::Objective::orienteering
               ? problem_->budget_s
               : std::numeric_limits<double>::infinity();
  }
  std::vector<std::size_t>& targets_of(int view) {
    return targets_of_[static_cast<std::size_t>(view)];
  }
  void count(int view, int by) {
    for (const std::size_t j : targets_of(view)) seen_[j] += by;
  }
  double new_weight(int view) {
    double sum = 0.0;
    for (const std::size_t j : targets_of(view)) sum += seen_[j] == 0 ? problem_->weight[j] : 0.0;
    return sum;
  }
  /// From the view at place − 1, or the start.
  [[nodiscard]] double leg_s(std::size_t place, int to) const {
    const auto view = static_cast<std::size_t>(to);
    return place == 0 ? problem_->from_start_s[view]
                      : problem_->between_s[static_cast<std::size_t>(path_[place - 1])][view];
  }
  [[nodiscard]] Insertion cheapest(int view) const {
    Insertion best{view, 0, std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t place = 0; place <= path_.size(); ++place) {
      double more_s = leg_s(place, view);
      if (place < path_.size()) {
        more_s += problem_->between_s[static_cast<std::size_t>(view)]
                                     [static_cast<std::size_t>(path_[place])] -
                  leg_s(place, path_[place]);
      }
      if (more_s < best.more_s) best = {view, place, more_s, 0.0};
    }
    return best;
  }
  [[nodiscard]] double saved_without(std::size_t place) const {
    double saved_s = leg_s(place, path_[place]);
    if (place + 1 < path_.size())
      saved_s += leg_s(place + 1, path_[place + 1]) - leg_s(place, path_[place + 1]);
    return saved_s;
  }

  const InspectionProblem* problem_;
  InspectionPath path_;
  std::vector<std::vector<std::size_t>> targets_of_;
  std::vector<int> seen_;
};

/// The same views in a quicker order; false: neither 2-opt nor or-opt finds one.
bool reorder_once(const InspectionProblem& problem, InspectionPath& path) {
  const double now_s = path_time_s(problem, path);
  const auto quicker = [&](const InspectionPath& other) {
    if (path_time_s(problem, other) >= now_s - kLess) return false;
    path = other;
    return true;
  };
  const auto at = [](InspectionPath& p, std::size_t i) {
    return p.begin() + static_cast<std::ptrdiff_t>(i);
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::size_t j = i + 2; j <= path.size(); ++j) {
      InspectionPath other = path;
      std::reverse(at(other, i), at(other, j));
      if (quicker(other)) return true;
      for (std::size_t row = 1; row <= std::min(kMaxRow, j - i - 1); ++row) {
        other = path;  // the first ones to the end of the stretch, and the last ones to its front
        std::rotate(at(other, i), at(other, i + row), at(other, j));
        if (quicker(other)) return true;
        other = path;
        std::rotate(at(other, i), at(other, j - row), at(other, j));
        if (quicker(other)) return true;
      }
    }
  }
  return false;
}

/// A view in place of another; false: none makes the path cheaper.
bool replace_once(const InspectionProblem& problem, InspectionPath& path) {
  const double now = path_cost(problem, path);
  const double now_s = path_time_s(problem, path);
  const bool cover = problem.objective == InspectionProblem::Objective::cover;
  for (int& view : path) {
    const int kept = view;
    for (int other = 0; other < problem.views(); ++other) {
      if (std::find(path.begin(), path.end(), other) != path.end()) continue;
      view = other;
      const bool may = !cover || path_time_s(problem, path) < now_s;  // the cheap look first
      if (may && path_is_valid(problem, path) && path_cost(problem, path) < now - kLess)
        return true;
      view = kept;
    }
  }
  return false;
}

}  // namespace

InspectionPath improved_path(const InspectionProblem& problem, InspectionPath path) {
  for (int round = 0; round < kMaxRounds; ++round) {
    if (reorder_once(problem, path)) continue;
    GrowingPath growing(problem, path);
    growing.drop_idle();
    while (growing.grow()) {
    }
    const bool changed = growing.path() != path;
    path = growing.path();
    if (!changed && !replace_once(problem, path)) break;
  }
  return path;
}

InspectionPath greedy_path(const InspectionProblem& problem) {
  GrowingPath path(problem, {});
  while (path.grow()) {
  }
  path.drop_idle();
  return improved_path(problem, path.path());
}

}  // namespace canopeer
