#include "bound_table.h"

#include <cstdio>
#include <string>

namespace canopeer::app {
namespace {

constexpr double kRoundingOfBounds = 1e-6;

std::string figure(const std::optional<double>& value, int decimals) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, *value);
  return text;
}

void print_bound(const char* name, const std::optional<UpperBound>& bound) {
  if (!bound) return;
  std::printf("%-28s %8s %8s   by %s\n", name, figure(bound->fruits, 1).c_str(),
              figure(bound->auc, 3).c_str(), bound->by.c_str());
}

void print_best(const char* name, const std::optional<BestResult>& best) {
  if (!best) return;
  std::printf("%-28s %8d %8.3f   %s\n", name, best->detected, best->auc, best->planner.c_str());
}

void print_pipeline(const PipelineCeiling& p) {
  std::printf("%-28s %8d          of %d frames, %d false; surface %.3f, F1 at 0.015 m %s\n",
              "ceiling through the pipeline", p.detected, p.views, p.false_positives, p.surface,
              figure(p.surface_f1, 3).c_str());
  std::printf(
      "%-28s seen area with which a fruit was reported: %.2f cm2 at least, %.2f in 19 of "
      "20; even chances at %.2f (%.0f %% of %d cases wrong)\n",
      "", p.find.least_cm2, p.find.twentieth_cm2, p.find.even_cm2, 100.0 * p.find.wrong_share,
      p.find.cases);
}

/// Says it where the larger is below the smaller.
bool in_order(const char* larger_name, const std::optional<double>& larger,
              const char* smaller_name, const std::optional<double>& smaller) {
  if (!larger || !smaller || *larger >= *smaller - kRoundingOfBounds) return true;
  std::fprintf(stderr, "canopeer: notice: %s (%.4g) is below %s (%.4g): one of them is wrong\n",
               larger_name, *larger, smaller_name, *smaller);
  return false;
}

std::optional<double> fruits_in(const std::optional<BestResult>& best) {
  return best ? std::optional<double>(best->detected) : std::nullopt;
}
std::optional<double> auc_in(const std::optional<BestResult>& best) {
  return best ? std::optional<double>(best->auc) : std::nullopt;
}
std::optional<double> fruits_in(const std::optional<UpperBound>& bound) {
  return bound ? bound->fruits : std::nullopt;
}
std::optional<double> auc_in(const std::optional<UpperBound>& bound) {
  return bound ? bound->auc : std::nullopt;
}

}  // namespace

void print_bounds(const BoundResults& r) {
  const Yardstick& y = r.yardstick;
  std::printf("%s, world seed %llu (%s), protocol %s: %d fruits count\n\n%-28s %8s %8s\n",
              y.mission.c_str(), static_cast<unsigned long long>(y.world_seed),
              y.world_hash.c_str(), y.protocol.c_str(), y.fruits_total, "", "fruits", "AUC");
  print_bound("certified bound", y.certified);
  print_bound("sampled bound", y.sampled);
  std::printf("%-28s %8d          of %lld views; surface %.3f; %.2f %% of patches seen once\n",
              "visibility ceiling", r.ceiling.fruits, static_cast<long long>(r.ceiling.views),
              r.ceiling.surface, 100.0 * r.ceiling.seen_once);
  if (r.pipeline) print_pipeline(*r.pipeline);
  print_best("best plan for fruits", y.best_found);
  print_best("best plan for AUC", y.best_auc);
  std::printf(
      "\nviews that show all patches %d (at least %d), 90 %% of their surface %d (at least "
      "%d);\nthat find all fruits %d, 90 %% of them %d\n",
      y.cover_views_100.value_or(0), r.cover.at_least_100, y.cover_views_90.value_or(0),
      r.cover.at_least_90, r.cover.fruit_views_100, r.cover.fruit_views_90);
}

bool check_bounds(const Yardstick& y) {
  const std::optional<double> ceiling =
      y.ceiling_fruits ? std::optional<double>(*y.ceiling_fruits) : std::nullopt;
  bool well = in_order("the visibility ceiling", ceiling, "the fruits of a plan executed",
                       fruits_in(y.best_found));
  for (const auto* bound : {&y.sampled, &y.certified}) {
    const char* name = bound == &y.sampled ? "the sampled bound" : "the certified bound";
    well &= in_order((std::string(name) + " on fruits").c_str(), fruits_in(*bound),
                     "what a plan executed found", fruits_in(y.best_found));
    well &= in_order((std::string(name) + " on AUC").c_str(), auc_in(*bound),
                     "the AUC of a plan executed", auc_in(y.best_auc));
  }
  return well;
}

}  // namespace canopeer::app
