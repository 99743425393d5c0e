#include "canopeer/bounds/tours/tour_local_search.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace canopeer {
namespace {

constexpr double kBetter = 1e-7;
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

using Order = std::vector<int>;

/// A tour with what is known before each of its segments.
class StandingTour {
 public:
  StandingTour(const TourProblem& problem, Tour tour) : problem_(problem), tour_(std::move(tour)) {
    before_.assign(1, TourState{TourCoverage(problem)});
    pass(0);
  }

  [[nodiscard]] const Tour& tour() const { return tour_; }
  [[nodiscard]] double score() const { return before_.back().score; }
  [[nodiscard]] const Order& of(std::size_t segment) const { return tour_[segment]; }

  /// Of the tour with another order of one segment; later ones lose the views for which there is no
  /// time left.
  [[nodiscard]] double score_with(std::size_t segment, const Order& order) const {
    TourState state = before_[segment];
    const auto taken = go_through(problem_, static_cast<int>(segment), order, state);
    if (taken < order.size()) return kImpossible;
    for (std::size_t s = segment + 1; s < tour_.size(); ++s) {
      static_cast<void>(go_through(problem_, static_cast<int>(s), tour_[s], state));
    }
    return state.score;
  }

  void set(std::size_t segment, Order order) {
    tour_[segment] = std::move(order);
    pass(segment);
  }

  /// The views that add most to all but this segment's.
  [[nodiscard]] Order candidates(std::size_t segment, int most) const {
    TourState rest{TourCoverage(problem_)};
    for (std::size_t s = 0; s < tour_.size(); ++s) {
      rest.seen.add(problem_.segments[s].front());
      if (s == segment) continue;
      for (const int view : tour_[s]) {
        rest.seen.add(problem_.segments[s][static_cast<std::size_t>(view)]);
      }
    }
    // What comes early counts too, even of fruits that others find later.
    std::vector<std::pair<double, int>> views;
    const auto& all = problem_.segments[segment];
    for (std::size_t v = 1; v < all.size(); ++v) {
      const double alone = before_[segment].seen.gain(all[v], problem_.early, nullptr);
      const double gain = rest.seen.gain(all[v], problem_.ever, nullptr) + alone;
      if (gain > 0.0) views.emplace_back(-gain, static_cast<int>(v));
    }
    std::sort(views.begin(), views.end());
    if (views.size() > static_cast<std::size_t>(most)) views.resize(static_cast<std::size_t>(most));
    Order found;
    for (const auto& [gain, view] : views) found.push_back(view);
    return found;
  }

 private:
  void pass(std::size_t from) {
    before_.erase(before_.begin() + static_cast<std::ptrdiff_t>(from) + 1, before_.end());
    for (std::size_t s = from; s < tour_.size(); ++s) {
      TourState state = before_[s];
      tour_[s].resize(go_through(problem_, static_cast<int>(s), tour_[s], state));
      before_.push_back(std::move(state));
    }
  }

  const TourProblem& problem_;
  Tour tour_;
  std::vector<TourState> before_;  ///< by segment, and after the last
};

Order with_put_in(const Order& order, std::size_t place, int view) {
  Order other = order;
  other.insert(other.begin() + static_cast<std::ptrdiff_t>(place), view);
  return other;
}

/// Every order that is one step away.
template <typename Try>
void each_step(const Order& order, const Order& candidates, const Try& try_order) {
  const std::size_t n = order.size();
  for (const int view : candidates) {
    if (std::find(order.begin(), order.end(), view) != order.end()) continue;
    for (std::size_t i = 0; i <= n; ++i) try_order(with_put_in(order, i, view));
    for (std::size_t i = 0; i < n; ++i) {
      Order other = order;
      other[i] = view;
      try_order(std::move(other));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    Order other = order;
    other.erase(other.begin() + static_cast<std::ptrdiff_t>(i));
    try_order(std::move(other));
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {  // 2-opt
    for (std::size_t j = i + 1; j < n; ++j) {
      Order other = order;
      std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i),
                   other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      try_order(std::move(other));
    }
  }
  for (std::size_t length = 1; length <= std::min<std::size_t>(3, n); ++length) {  // or-opt
    for (std::size_t i = 0; i + length <= n; ++i) {
      Order rest = order;
      const auto first = rest.begin() + static_cast<std::ptrdiff_t>(i);
      const Order stretch(first, first + static_cast<std::ptrdiff_t>(length));
      rest.erase(first, first + static_cast<std::ptrdiff_t>(length));
      for (std::size_t place = 0; place <= rest.size(); ++place) {
        if (place == i) continue;
        Order other = rest;
        other.insert(other.begin() + static_cast<std::ptrdiff_t>(place), stretch.begin(),
                     stretch.end());
        try_order(std::move(other));
      }
    }
  }
}

bool all_free(const TourProblem& problem, std::size_t segment, const Order& order) {
  int at = 0;
  for (const int view : order) {
    if (!problem.motions->free(static_cast<int>(segment), at, view)) return false;
    at = view;
  }
  return true;
}

}  // namespace

Tour improve_tour(const TourProblem& problem, Tour tour, const TourLocalSearchOptions& options) {
  StandingTour standing(problem, std::move(tour));
  std::int64_t trials = 0;
  const auto improve_segment = [&](std::size_t segment) {
    std::vector<std::pair<double, Order>> better;
    const Order candidates = standing.candidates(segment, options.candidates);
    each_step(standing.of(segment), candidates, [&](Order order) {
      if (++trials > options.max_trials) return;
      const double score = standing.score_with(segment, order);
      if (score > standing.score() + kBetter) better.emplace_back(score, std::move(order));
    });
    std::stable_sort(better.begin(), better.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [score, order] : better) {
      if (!all_free(problem, segment, order)) continue;
      standing.set(segment, std::move(order));
      return true;
    }
    return false;
  };
  bool improved = true;
  while (improved && trials <= options.max_trials) {
    improved = false;
    for (std::size_t s = 0; s < standing.tour().size(); ++s) {
      while (trials <= options.max_trials && improve_segment(s)) improved = true;
    }
  }
  return standing.tour();
}

}  // namespace canopeer
