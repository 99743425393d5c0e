#include "canopeer/campaign/suite_score.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace canopeer {
namespace {

using Key = std::pair<std::string, std::string>;

double auc_of(const std::optional<BestResult>& result) { return result ? result->auc : 0.0; }

/// By world and protocol.
std::map<Key, double> known_auc(const std::vector<SuiteReference>& references) {
  std::map<Key, double> known;
  for (const SuiteReference& r : references) {
    if (r.auc > 0.0) known[{r.world, r.protocol}] = r.auc;
  }
  return known;
}

SuiteScore score(const Key& contestant, const std::vector<const SuiteRun*>& runs,
                 const std::map<Key, double>& references, bool normalised) {
  SuiteScore result;
  result.planner = contestant.first;
  result.protocol = contestant.second;
  result.runs = static_cast<int>(runs.size());
  result.normalised = normalised;
  std::map<std::string, std::vector<double>> worlds;
  for (const SuiteRun* run : runs) {
    const double reference = normalised ? references.at({run->world, run->protocol}) : 1.0;
    worlds[run->world].push_back(run->auc / reference);
  }
  std::vector<double> means;
  for (const auto& [world, values] : worlds) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    means.push_back(sum / static_cast<double>(values.size()));
  }
  result.worlds = static_cast<int>(means.size());
  result.value = sample_figures(means);
  return result;
}

bool same(const SuiteScore& a, const SuiteScore& b) {
  constexpr double kDigits = 1e-9;  // numbers went through text
  return a.planner == b.planner && a.protocol == b.protocol && a.normalised == b.normalised &&
         a.worlds == b.worlds && a.runs == b.runs &&
         std::abs(a.value.mean - b.value.mean) < kDigits &&
         std::abs(a.value.low95 - b.value.low95) < kDigits &&
         std::abs(a.value.high95 - b.value.high95) < kDigits;
}

}  // namespace

SuiteRun suite_run(const RunFigures& figures) {
  const auto value = [&](const char* key) { return figures.values[figure_index(key)]; };
  const auto count = [&](const char* key) { return static_cast<int>(value(key).value_or(0.0)); };
  SuiteRun run;
  run.world = figures.job.mission_name;
  run.protocol = figures.job.protocol;
  run.planner = figures.job.contestant.label();
  run.seed = figures.job.seed;
  run.fruits_total = figures.fruits_total;
  run.detected = count("detected");
  run.detected_paper = count("detected_paper");
  run.auc = value("auc").value_or(0.0);
  run.mission_time_s = value("mission_time_s").value_or(figures.planned_s);
  run.views = count("views");
  run.false_positives = count("false_positives");
  run.surface_f1 = value("surface_f1");
  run.volume_error_mean = value("volume_error_mean");
  run.joint_path_rad = value("joint_path_rad").value_or(0.0);
  run.collisions = count("collisions");
  return run;
}

std::optional<SuiteReference> reference_of(const std::string& world, const std::string& protocol,
                                           const Yardstick& yardstick) {
  const auto& best = auc_of(yardstick.clairvoyant) > auc_of(yardstick.best_auc)
                         ? yardstick.clairvoyant
                         : yardstick.best_auc;
  if (auc_of(best) <= 0.0) return std::nullopt;
  return SuiteReference{world, protocol, best->auc, best->planner};
}

std::vector<SuiteScore> suite_scores(const std::vector<SuiteRun>& runs,
                                     const std::vector<SuiteReference>& references) {
  const std::map<Key, double> known = known_auc(references);
  std::vector<Key> order;
  std::map<Key, std::vector<const SuiteRun*>> groups;
  std::map<std::string, bool> all_known;  // by protocol: the numbers of one table are of one kind
  for (const SuiteRun& run : runs) {
    const Key contestant{run.planner, run.protocol};
    if (groups.count(contestant) == 0) order.push_back(contestant);
    groups[contestant].push_back(&run);
    const bool has = known.count({run.world, run.protocol}) != 0;
    all_known.try_emplace(run.protocol, true).first->second &= has;
  }
  std::vector<SuiteScore> scores;
  for (const Key& contestant : order) {
    scores.push_back(
        score(contestant, groups.at(contestant), known, all_known.at(contestant.second)));
  }
  return scores;
}

bool same_scores(const std::vector<SuiteScore>& a, const std::vector<SuiteScore>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

}  // namespace canopeer
