#include "occlusion_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace canopeer::app {
namespace {

using Spread = OcclusionReport::Spread;

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double rank) {
    const double index = rank * static_cast<double>(values.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(index), values.size() - 1);
    const double t = index - static_cast<double>(i);
    return (1.0 - t) * values[i] + t * values[std::min(i + 1, values.size() - 1)];
  };
  return {at(0.1), at(0.5), at(0.9)};
}

std::string format(const char* pattern, double a, double b, double c) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, a, b, c);
  return text;
}

std::string json_spread(const char* name, const Spread& s) {
  return "\"" + std::string(name) +
         "\": " + format("{\"p10\": %.4f, \"p50\": %.4f, \"p90\": %.4f}", s.p10, s.p50, s.p90);
}

}  // namespace

OcclusionReport::OcclusionReport(const std::vector<FruitVisibility>& seen)
    : fruits(static_cast<int>(seen.size())) {
  std::vector<double> bests, medians, frontals, shares, unions;
  double frontal_sum = 0.0;
  int hidden = 0;
  int reachable = 0;
  for (const FruitVisibility& f : seen) {
    without_view += f.views == 0;
    bests.push_back(f.best);
    if (f.views > 0) medians.push_back(f.median);
    if (f.views > 0) shares.push_back(f.share_above_30);
    frontals.push_back(f.frontal);
    unions.push_back(f.union_surface);
    mean_union += f.union_surface;
    frontal_sum += f.union_frontal;
    if (f.best_frontal_level >= 0.3) continue;
    ++hidden;
    reachable += f.best >= 0.3;
  }
  best = spread_of(bests);
  median = spread_of(medians);
  frontal = spread_of(frontals);
  share_above_30 = spread_of(shares);
  union_surface = spread_of(unions);
  if (fruits == 0) return;
  mean_union /= fruits;
  mean_union_frontal = frontal_sum / fruits;
  hidden_from_front = hidden / static_cast<double>(fruits);
  if (hidden > 0) hidden_but_reachable = reachable / static_cast<double>(hidden);
}

std::string as_text(const OcclusionReport& r) {
  const auto row = [](const char* name, const Spread& s) {
    return "  " + std::string(name) + format("  %5.2f %5.2f %5.2f\n", s.p10, s.p50, s.p90);
  };
  std::string text = "                                            p10   p50   p90\n";
  text += row("facing surface seen, best position      ", r.best);
  text += row("the same, median position               ", r.median);
  text += row("the same, straight in front, mid-aisle  ", r.frontal);
  text += row("positions that show 30 % or more        ", r.share_above_30);
  text += row("whole surface, all positions together   ", r.union_surface);
  text += format("  mean of the last %.2f; from in front only %.2f\n", r.mean_union,
                 r.mean_union_frontal, 0.0);
  text += format(
      "  never above 30 %% from level in front: %.0f %% of the fruits; %.0f %% of these "
      "are from elsewhere\n",
      100.0 * r.hidden_from_front, 100.0 * r.hidden_but_reachable, 0.0);
  if (r.without_view > 0) {
    text += "  fruits without any allowed position: " + std::to_string(r.without_view) + "\n";
  }
  return text;
}

std::string as_json(const OcclusionReport& r) {
  return "{\"fruits\": " + std::to_string(r.fruits) +
         ", \"fruits_without_view\": " + std::to_string(r.without_view) + ", " +
         json_spread("best", r.best) + ", " + json_spread("median", r.median) + ", " +
         json_spread("frontal", r.frontal) + ", " +
         json_spread("share_above_30", r.share_above_30) + ", " +
         json_spread("union_surface", r.union_surface) +
         format(", \"mean_union\": %.4f, \"mean_union_frontal\": %.4f, \"hidden_from_front\": %.4f",
                r.mean_union, r.mean_union_frontal, r.hidden_from_front) +
         format(", \"hidden_but_reachable\": %.4f}", r.hidden_but_reachable, 0.0, 0.0);
}

}  // namespace canopeer::app
