#include <fmt/format.h>

#include <map>
#include <set>

#include "canopeer/campaign/suite_results.h"

namespace canopeer {
namespace {

using Faults = std::vector<std::string>;

std::string name_of(const SuiteRun& r) {
  return fmt::format("{}, {}, {}, seed {}", r.planner, r.world, r.protocol, r.seed);
}

void check_rules(const SuiteResults& results, const Suite& suite, Faults& faults) {
  if (results.suite_version != suite.version || results.suite_sha256 != suite.sha256) {
    faults.push_back(
        fmt::format("it is of suite {} ({:.12}…), this is suite {} ({:.12}…): other frozen files",
                    results.suite_version, results.suite_sha256, suite.version, suite.sha256));
  }
  for (const std::string& setting : results.settings) {
    faults.push_back(
        fmt::format("setting {} was overridden; entries run as they are frozen", setting));
  }
  if (results.runs.empty()) faults.emplace_back("it holds no runs");
}

void check_run(const SuiteRun& run, const Suite& suite, Faults& faults) {
  const SuiteWorld* const world = suite.find(run.world);
  if (world == nullptr) {
    faults.push_back(fmt::format("{}: there is no such world", name_of(run)));
    return;
  }
  if (run.planner.find('@') != std::string::npos) {
    faults.push_back(fmt::format("{}: with a compute table of its own", name_of(run)));
  }
  if (run.fruits_total != world->fruits_counted) {
    faults.push_back(fmt::format("{}: of {} fruits, the world has {}", name_of(run),
                                 run.fruits_total, world->fruits_counted));
  }
  // Fruits found once may be lost again, so the last count says nothing about AUC but that both
  // are shares.
  const bool possible = run.detected >= 0 && run.detected <= run.fruits_total &&
                        run.detected_paper >= 0 && run.detected_paper <= run.fruits_total &&
                        run.auc >= 0.0 && run.auc <= 1.0 && run.mission_time_s >= 0.0 &&
                        run.views >= 0 && run.false_positives >= 0 && run.collisions >= 0;
  if (!possible) faults.push_back(fmt::format("{}: figures that cannot be", name_of(run)));
}

/// Every planner and protocol: all worlds of the split, each with the same seeds, each run once.
void check_whole(const SuiteResults& results, const Suite& suite, Faults& faults) {
  const auto worlds = worlds_of(suite, results.split);
  if (!worlds) {
    faults.push_back(worlds.error().message);
    return;
  }
  using Pair = std::pair<std::string, std::string>;
  std::map<Pair, std::map<std::string, std::multiset<std::uint64_t>>> seeds;
  std::set<std::uint64_t> all_seeds;
  for (const SuiteRun& run : results.runs) {
    seeds[{run.planner, run.protocol}][run.world].insert(run.seed);
    all_seeds.insert(run.seed);
  }
  const std::multiset<std::uint64_t> expected(all_seeds.begin(), all_seeds.end());
  for (const auto& [contestant, its] : seeds) {
    int wrong = 0;
    for (const SuiteWorld& world : *worlds) {
      const auto found = its.find(world.name);
      wrong += found == its.end() || found->second != expected;
    }
    if (wrong == 0 && its.size() == worlds->size()) continue;
    faults.push_back(fmt::format(
        "{}, {}: not every seed once on every world of {}: {} of {} worlds are not "
        "complete, {} worlds have runs",
        contestant.first, contestant.second, results.split, wrong, worlds->size(), its.size()));
  }
}

void check_scores(const SuiteResults& results, Faults& faults) {
  if (!same_scores(suite_scores(results.runs, results.references), results.scores)) {
    faults.emplace_back("its scores do not follow from its runs");
  }
}

}  // namespace

std::vector<std::string> faults_of(const SuiteResults& results, const Suite& suite) {
  Faults faults;
  check_rules(results, suite, faults);
  for (const SuiteRun& run : results.runs) check_run(run, suite, faults);
  check_whole(results, suite, faults);
  check_scores(results, faults);
  return faults;
}

}  // namespace canopeer
