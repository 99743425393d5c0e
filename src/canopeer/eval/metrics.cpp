#include "canopeer/eval/metrics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "canopeer/base/check.h"
#include "canopeer/eval/matching.h"
#include "canopeer/record/fruit_course.h"

namespace canopeer {
namespace {

template <typename Fruits>
std::vector<Vec3> centres_of(const Fruits& fruits) {
  std::vector<Vec3> centres;
  centres.reserve(fruits.size());
  for (const auto& fruit : fruits) centres.push_back(fruit.centre);
  return centres;
}

std::vector<FoundAtTime> found_over_time(const RunRecord& record,
                                         std::span<const FruitTruth> truth) {
  std::vector<FoundAtTime> found;
  std::vector<Vec3> last;
  for (const FruitsAtTime& at : fruit_course(record)) {
    std::vector<Vec3> centres = centres_of(*at.fruits);
    if (!found.empty() && centres == last) {  // most frames on the way move no fruit
      found.push_back(found.back());
      found.back().t_s = at.t_s;
      continue;
    }
    found.push_back({at.t_s, static_cast<int>(match_optimal(centres, truth).pairs.size()),
                     static_cast<int>(match_greedy(centres, truth).pairs.size())});
    last = std::move(centres);
  }
  return found;
}

std::optional<double> time_to_share(const std::vector<FoundAtTime>& found, double share,
                                    int fruits_total) {
  if (fruits_total == 0) return std::nullopt;
  for (const FoundAtTime& at : found) {
    if (at.detected >= share * fruits_total - 1e-9) return at.t_s;
  }
  return std::nullopt;
}

/// Mean of detected / fruits_total over [0, end]: what is known stays known until the next frame.
double mean_detected_share(const std::vector<FoundAtTime>& found, double end_s, int fruits_total) {
  if (fruits_total == 0 || !(end_s > 0.0)) return 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double from = std::clamp(found[i].t_s, 0.0, end_s);
    const double to = i + 1 < found.size() ? std::clamp(found[i + 1].t_s, from, end_s) : end_s;
    area += (to - from) * found[i].detected;
  }
  return area / (end_s * fruits_total);
}

/// Detected at time `t_s`, from the frames until then.
int detected_at(const std::vector<FoundAtTime>& found, double t_s) {
  const auto later = std::upper_bound(found.begin(), found.end(), t_s,
                                      [](double t, const FoundAtTime& f) { return t < f.t_s; });
  return later == found.begin() ? 0 : std::prev(later)->detected;
}

/// Mean of detected / fruits_total over the views a rule gives, as many to each segment: views that
/// a segment did not take keep the count of its end, segments not begun that of the run's.
std::optional<double> mean_share_over_views(const RunRecord& record,
                                            const std::vector<FoundAtTime>& found,
                                            int fruits_total) {
  const int planned = record.header.views_planned;
  if (planned <= 0 || record.header.segments <= 0 || fruits_total == 0) return std::nullopt;
  const int each = planned / record.header.segments;
  double sum = 0.0;
  for (const SegmentEvent& segment : record.segments) {
    int left = each;
    for (const ViewEvent& view : record.views) {
      if (view.segment != segment.segment || left == 0) continue;
      sum += detected_at(found, view.t_s);
      --left;
    }
    sum += left * detected_at(found, segment.end_s);
  }
  const auto begun = static_cast<int>(record.segments.size());
  sum += (record.header.segments - begun) * each * detected_at(found, record.end_s);
  return sum / (each * record.header.segments * fruits_total);
}

double volume_error(double estimated_cm3, double true_cm3) {
  return std::abs(estimated_cm3 - true_cm3) / true_cm3;
}

/// Mean errors over pairs; null without any.
struct MeanErrors {
  double distance_sum = 0.0, volume_sum = 0.0;
  double estimated_cm3 = 0.0, true_cm3 = 0.0;  // of pairs with a true volume
  int pairs = 0, volumes = 0;

  void add(const FruitPair& pair, const FruitEstimate& estimate, const FruitTruth& truth) {
    distance_sum += pair.distance_m;
    ++pairs;
    if (!(truth.volume_cm3 > 0.0)) return;
    volume_sum += volume_error(estimate.volume_cm3, truth.volume_cm3);
    estimated_cm3 += estimate.volume_cm3;
    true_cm3 += truth.volume_cm3;
    ++volumes;
  }
  [[nodiscard]] std::optional<double> centre() const {
    return pairs > 0 ? std::optional(distance_sum / pairs) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> volume() const {
    return volumes > 0 ? std::optional(volume_sum / volumes) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> volume_ratio_pct() const {
    return volumes > 0 ? std::optional(100.0 * estimated_cm3 / true_cm3) : std::nullopt;
  }
};

void score_final_fruits(std::span<const FruitEstimate> fruits, std::span<const FruitTruth> truth,
                        std::span<const double> coverage, RunMetrics& metrics) {
  const std::vector<Vec3> centres = centres_of(fruits);
  const FruitMatching strict = match_optimal(centres, truth);
  metrics.detected = static_cast<int>(strict.pairs.size());
  metrics.false_positives = strict.false_positives;
  MeanErrors all;
  MeanErrors half_seen;
  for (const FruitPair& pair : strict.pairs) {
    const FruitEstimate& estimate = fruits[static_cast<std::size_t>(pair.estimate)];
    const std::size_t t = static_cast<std::size_t>(pair.truth);
    all.add(pair, estimate, truth[t]);
    if (!coverage.empty() && coverage[t] >= 0.5) half_seen.add(pair, estimate, truth[t]);
  }
  metrics.centre_error_mean_m = all.centre();
  metrics.volume_error_mean = all.volume();
  metrics.volume_ratio_pct = all.volume_ratio_pct();
  if (!coverage.empty()) {
    metrics.fruits_half_seen = half_seen.pairs;
    metrics.centre_error_half_seen_m = half_seen.centre();
    metrics.volume_error_half_seen = half_seen.volume();
  }

  const FruitMatching paper = match_greedy(centres, truth);
  metrics.detected_paper = static_cast<int>(paper.pairs.size());
  metrics.false_positives_paper = paper.false_positives;
  metrics.ma50 = static_cast<int>(
      std::count_if(paper.pairs.begin(), paper.pairs.end(), [&](const FruitPair& pair) {
        const double true_cm3 = truth[static_cast<std::size_t>(pair.truth)].volume_cm3;
        const double estimated = fruits[static_cast<std::size_t>(pair.estimate)].volume_cm3;
        return true_cm3 > 0.0 && 1.0 - volume_error(estimated, true_cm3) > 0.5;
      }));
}

/// F1 of the fruits that a run has seen enough of to know them.
void score_seen_fruits(std::span<const FruitEstimate> fruits, std::span<const FruitTruth> truth,
                       std::span<const double> coverage, RunMetrics& metrics) {
  if (coverage.empty()) return;
  constexpr double kEnough = 0.3;
  int seen = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) seen += truth[i].counted && coverage[i] >= kEnough;
  const FruitMatching matching = match_optimal(centres_of(fruits), truth);
  const auto found = static_cast<int>(
      std::count_if(matching.pairs.begin(), matching.pairs.end(), [&](const FruitPair& pair) {
        return coverage[static_cast<std::size_t>(pair.truth)] >= kEnough;
      }));
  metrics.fruits_seen_30pct = seen;
  metrics.detected_seen_30pct = found;
  const int all = found + seen + matching.false_positives;
  if (all > 0) metrics.f1_seen_30pct = 2.0 * found / all;
}

/// Of the counted fruits together: a large fruit counts as much as its surface is.
std::optional<double> mean_coverage(std::span<const FruitTruth> truth,
                                    std::span<const double> coverage) {
  double seen = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    if (!truth[i].counted) continue;
    seen += std::clamp(coverage[i], 0.0, 1.0) * truth[i].surface_cm2;
    all += truth[i].surface_cm2;
  }
  if (!(all > 0.0)) return std::nullopt;
  return seen / all;
}

}  // namespace

RunMetrics compute_metrics(const RunRecord& record, std::span<const FruitEstimate> fruits,
                           std::span<const FruitTruth> truth, std::span<const double> coverage) {
  CANOPEER_CHECK(coverage.empty() || coverage.size() == truth.size(), "one share per true fruit");
  RunMetrics metrics{summary_of(record), {}};
  const auto total = static_cast<int>(std::count_if(
      truth.begin(), truth.end(), [](const FruitTruth& fruit) { return fruit.counted; }));
  metrics.fruits_total = total;
  score_final_fruits(fruits, truth, coverage, metrics);
  if (total > 0) {
    const int counted = *metrics.detected + *metrics.false_positives;
    metrics.count_accuracy_pct =
        100.0 * (1.0 - std::abs(counted - total) / static_cast<double>(total));
  }
  score_seen_fruits(fruits, truth, coverage, metrics);
  metrics.roi_surface_coverage = mean_coverage(truth, coverage);
  metrics.found = found_over_time(record, truth);
  metrics.time_to_50pct_s = time_to_share(metrics.found, 0.5, total);
  metrics.time_to_80pct_s = time_to_share(metrics.found, 0.8, total);
  metrics.time_to_90pct_s = time_to_share(metrics.found, 0.9, total);
  const double whole_s = record.header.mission_time_s;
  if (!record.header.without_time_limit()) {
    metrics.auc = mean_detected_share(metrics.found, whole_s > 0.0 ? whole_s : record.end_s, total);
  }
  metrics.auc_views = mean_share_over_views(record, metrics.found, total);
  return metrics;
}

}  // namespace canopeer
