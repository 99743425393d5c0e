#include "canopeer/bounds/tours/tour_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

namespace canopeer {
namespace {

constexpr double kNothing = 1e-9;
constexpr double kLeastGain = 0.004;  // of a fruit: a view that is worth a look

/// A partial tour that is kept.
struct Label {
  int parent = -1;
  int view = 0;
  int views = 1;     ///< that at home included
  double t_s = 0.0;  ///< it is done with
  double score = 0.0;
  std::uint64_t views_key = 0;  ///< of the set of its views
};

/// One that may be kept.
struct NextView {
  int parent = 0;
  int view = 0;
  double t_s = 0.0;
  double score = 0.0;
};

bool better(const NextView& a, const NextView& b) {
  if (a.score != b.score) return a.score > b.score;
  if (a.t_s != b.t_s) return a.t_s < b.t_s;
  if (a.parent != b.parent) return a.parent < b.parent;
  return a.view < b.view;
}

/// Those that end in one slice of time: the best so many.
class Slice {
 public:
  void put(const NextView& offer, std::size_t most) {
    if (offers_.size() < most) {
      offers_.push_back(offer);
      std::push_heap(offers_.begin(), offers_.end(), better);  // the worst is in front
    } else if (better(offer, offers_.front())) {
      std::pop_heap(offers_.begin(), offers_.end(), better);
      offers_.back() = offer;
      std::push_heap(offers_.begin(), offers_.end(), better);
    }
  }
  [[nodiscard]] std::vector<NextView> sorted() {
    std::sort(offers_.begin(), offers_.end(), better);
    return std::move(offers_);
  }

 private:
  std::vector<NextView> offers_;
};

std::uint64_t key_of(int view) {
  std::uint64_t x = static_cast<std::uint64_t>(view) + 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

class SegmentSearch {
 public:
  SegmentSearch(const TourProblem& problem, int segment, const TourState& state,
                const double* later, const TourBeamOptions& options)
      : problem_(problem),
        segment_(segment),
        views_(problem.segments[static_cast<std::size_t>(segment)]),
        later_(later),
        options_(options),
        time_(problem, segment, state.t_s),
        start_s_(time_.after_home_s()),
        timed_(std::isfinite(time_.time_up_s())),
        slices_(static_cast<std::size_t>(timed_ ? options.slices + 1 : options.most_views + 1)) {
    Label home;
    home.t_s = start_s_;
    home.score = state.seen.gain(views_.front(), problem.weight(state.t_s), later);
    labels_.push_back(home);
    auto seen = std::make_unique<TourCoverage>(state.seen);
    seen->add(views_.front());
    choose_candidates(*seen, problem.weight(start_s_));
    expand(0, *seen, 0);
    for (std::size_t s = 0; s < slices_.size(); ++s) keep_best(s, state);
  }

  [[nodiscard]] std::vector<int> best(double lateness) const {
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const double next_s = time_.end_s(labels_[i].t_s, labels_[i].views) +
                            problem_.motions->transition_s(segment_, labels_[i].view);
      const double score = labels_[i].score - lateness * next_s;
      if (score <= most + kNothing) continue;
      most = score;
      best = i;
    }
    return views_of(static_cast<int>(best));
  }

 private:
  /// The views that add most to what is seen at home; later they add no more.
  void choose_candidates(const TourCoverage& seen, double weight) {
    const double least = kLeastGain * weight;
    std::vector<std::pair<double, int>> order;
    for (std::size_t v = 1; v < views_.size(); ++v) {
      const double gain = seen.gain(views_[v], weight, later_);
      if (gain > least) order.emplace_back(-gain, static_cast<int>(v));
    }
    std::sort(order.begin(), order.end());
    const auto most = static_cast<std::size_t>(options_.candidates);
    if (order.size() > most) order.resize(most);
    for (const auto& [gain, view] : order) candidates_.push_back(view);
  }

  /// The best of the slice that differ become labels, and are gone on from.
  void keep_best(std::size_t slice, const TourState& state) {
    std::map<std::uint64_t, int> same_views;
    int kept = 0;
    for (const NextView& offer : slices_[slice].sorted()) {
      if (kept == options_.width) break;
      const Label& parent = labels_[static_cast<std::size_t>(offer.parent)];
      const std::uint64_t key = parent.views_key ^ key_of(offer.view);
      int& same = same_views[key];
      if (same >= 2 || !problem_.motions->free(segment_, parent.view, offer.view)) continue;
      ++same;
      ++kept;
      const int views = parent.views + 1;
      labels_.push_back({offer.parent, offer.view, views, offer.t_s, offer.score, key});
      const int label = static_cast<int>(labels_.size()) - 1;
      TourCoverage seen = state.seen;
      seen.add(views_.front());
      for (const int view : views_of(label)) seen.add(views_[static_cast<std::size_t>(view)]);
      expand(label, seen, slice + 1);
    }
  }

  void expand(int index, const TourCoverage& seen, std::size_t first_slice) {
    const Label from = labels_[static_cast<std::size_t>(index)];
    if (from.views > options_.most_views || !time_.may_set_out(from.t_s, from.views)) return;
    const std::size_t most = 4 * static_cast<std::size_t>(options_.width);
    std::vector<char> taken(views_.size(), 0);
    for (const int view : views_of(index)) taken[static_cast<std::size_t>(view)] = 1;
    for (const int view : candidates_) {
      const auto v = static_cast<std::size_t>(view);
      if (taken[v] != 0) continue;
      const double there_s = from.t_s + problem_.motions->time_s(segment_, from.view, view);
      if (!std::isfinite(there_s) || !time_.counts(there_s)) continue;
      const double gain = seen.gain(views_[v], problem_.weight(there_s), later_);
      if (gain <= kNothing) continue;
      const NextView offer{index, view, there_s + problem_.clock.observe_s, from.score + gain};
      slices_[std::max(first_slice, slice_of(offer.t_s, from.views))].put(offer, most);
    }
  }

  /// By time; where there is no limit, by number of views. What ends behind the limit is last.
  [[nodiscard]] std::size_t slice_of(double t_s, int views) const {
    const std::size_t last = slices_.size() - 1;
    if (!timed_) return std::min(last, static_cast<std::size_t>(views - 1));
    const double share = (t_s - start_s_) / std::max(1e-9, time_.time_up_s() - start_s_);
    return std::min(last, static_cast<std::size_t>(std::max(0.0, share) * options_.slices));
  }

  [[nodiscard]] std::vector<int> views_of(int label) const {
    std::vector<int> views;
    for (; label > 0; label = labels_[static_cast<std::size_t>(label)].parent) {
      views.push_back(labels_[static_cast<std::size_t>(label)].view);
    }
    std::reverse(views.begin(), views.end());
    return views;
  }

  const TourProblem& problem_;
  int segment_;
  const std::vector<TourView>& views_;
  const double* later_;
  TourBeamOptions options_;
  SegmentTime time_;
  double start_s_;
  bool timed_;
  std::vector<int> candidates_;
  std::vector<Slice> slices_;
  std::vector<Label> labels_;  ///< the first: at home
};

}  // namespace

std::vector<int> search_segment(const TourProblem& problem, int segment, const TourState& state,
                                const double* later, double lateness,
                                const TourBeamOptions& options) {
  if (SegmentTime(problem, segment, state.t_s).never_begins()) return {};
  return SegmentSearch(problem, segment, state, later, options).best(lateness);
}

}  // namespace canopeer
