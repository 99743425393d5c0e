#include "suite_command.h"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/best_known.h"
#include "canopeer/campaign/job_pool.h"
#include "canopeer/campaign/suite_page.h"
#include "canopeer/campaign/suite_results.h"
#include "canopeer/config/protocols.h"
#include "commands.h"
#include "exit_status.h"
#include "records.h"
#include "shipped_data.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

/// The campaign that the suite is.
BenchArguments bench_of(const SuiteArguments& a, const std::vector<SuiteWorld>& worlds,
                        bool with_records) {
  BenchArguments bench;
  static_cast<CampaignArguments&>(bench) = a;
  for (const SuiteWorld& world : worlds) bench.missions.push_back(world.mission.string());
  if (with_records) bench.yardsticks = (records_folder() / "suite").string();
  bench.runs = a.seeds;
  bench.quiet = true;
  bench.progress = !a.quiet;
  return bench;
}

/// The finished runs, in the plan's order.
std::vector<RunFigures> finished_runs(const CampaignPlan& plan, const fs::path& out) {
  std::vector<RunFigures> runs;
  for (const CampaignJob& job : all_jobs(plan)) {
    if (!is_done(out, job)) continue;
    runs.push_back(value_or_stop(read_run_figures(out, job, yardstick_of(plan, job)), kFailed));
  }
  return runs;
}

/// Every world of the suite has a record, be it the first.
RecordOf suite_record_of(const Suite& suite) {
  return [&suite](const RunFigures& run) -> std::optional<RecordPlace> {
    const SuiteWorld* const world = suite.find(run.job.mission_name);
    if (world == nullptr || !run.job.contestant.table.empty()) return std::nullopt;
    Yardstick fresh;
    fresh.mission = world->name;
    fresh.protocol = run.job.protocol;
    fresh.world_seed = world->seed;
    fresh.fruits_total = world->fruits_counted;
    return RecordPlace{suite_record(world->name, run.job.protocol), fresh};
  };
}

std::vector<SuiteReference> references(const std::vector<SuiteWorld>& worlds,
                                       const std::vector<std::string>& protocols) {
  std::vector<SuiteReference> all;
  for (const std::string& protocol : protocols) {
    for (const SuiteWorld& world : worlds) {
      const fs::path file = records_folder() / suite_record(world.name, protocol);
      const auto known = value_or_stop(known_yardstick(file), kFailed);
      if (!known) continue;
      if (const auto reference = reference_of(world.name, protocol, *known)) {
        all.push_back(*reference);
      }
    }
  }
  return all;
}

void print_score(const SuiteScore& score) {
  std::printf("%-24s %-12s %s  (%s, %d worlds, %d runs)\n", score.planner.c_str(),
              score.protocol.c_str(), score_text(score).c_str(),
              score.normalised ? "AUC / best known" : "AUC", score.worlds, score.runs);
}

void write_suite(const SuiteArguments& a, const Suite& suite, const CampaignPlan& plan,
                 const std::vector<SuiteReference>& known) {
  SuiteResults results;
  results.canopeer_version = CANOPEER_VERSION;
  results.suite_version = suite.version;
  results.suite_sha256 = suite.sha256;
  results.split = a.split;
  results.settings = a.settings;
  const fs::path out = a.out;
  const std::vector<RunFigures> runs = finished_runs(plan, out);
  for (const RunFigures& run : runs) results.runs.push_back(suite_run(run));
  // Other settings are another contest.
  if (a.settings.empty()) keep_improvements(out, runs, suite_record_of(suite), a.quiet);
  results.references = known;
  results.scores = suite_scores(results.runs, results.references);
  value_or_stop(write_file(out / "results.json", suite_results_json(results)), kFailed);
  value_or_stop(write_file(out / "results.csv", suite_results_csv(results)), kFailed);
  value_or_stop(write_file(out / "suite.html", suite_page(results, suite, compare(plan, runs))),
                kFailed);
  if (a.quiet) return;
  for (const SuiteScore& score : results.scores) print_score(score);
  std::printf("page     %s\nhand in  %s\n", (out / "suite.html").c_str(),
              (out / "results.json").c_str());
}

Suite whole_suite() {
  Suite suite = value_or_stop(load_suite(shipped_data() / "benchmark"), kBadInput);
  value_or_stop(verify_suite(suite), kBadInput);
  return suite;
}

/// By the records that are here, whatever the entry was normalised by: so all entries compare.
void print_todays_scores(const std::string& file, const Suite& suite, const SuiteResults& entry) {
  std::set<std::string> protocols;
  for (const SuiteRun& run : entry.runs) protocols.insert(run.protocol);
  const auto worlds = value_or_stop(worlds_of(suite, entry.split), kBadInput);
  const auto known = references(worlds, {protocols.begin(), protocols.end()});
  const auto scores = suite_scores(entry.runs, known);
  for (const SuiteScore& score : scores) print_score(score);
  if (!same_scores(scores, entry.scores)) {
    std::printf("%s: its own scores differ, since it was normalised by other records\n",
                file.c_str());
  }
}

void check_entry(const SuiteArguments& a) {
  const Suite suite = whole_suite();
  const std::string text = value_or_stop(read_file(a.check), kBadInput);
  const auto results = parse_suite_results(text);
  if (!results) stop_with(kBadInput, {a.check + ": " + results.error().message});
  const std::vector<std::string> faults = faults_of(*results, suite);
  for (const std::string& fault : faults) std::fprintf(stderr, "canopeer: %s\n", fault.c_str());
  if (!faults.empty()) {
    stop_with(kFailed,
              {a.check + ": no valid entry, " + std::to_string(faults.size()) + " faults"});
  }
  print_todays_scores(a.check, suite, *results);
  std::printf("%s: a valid entry, %zu runs\n", a.check.c_str(), results->runs.size());
}

}  // namespace

void bench_suite(const SuiteArguments& a) {
  if (!a.check.empty()) return check_entry(a);
  if (a.out.empty())
    stop_with(kBadInput, {"bench suite: --out is missing, the folder of the runs"});
  const Suite suite = whole_suite();
  std::vector<SuiteWorld> worlds = value_or_stop(worlds_of(suite, a.split), kBadInput);
  if (!a.worlds.empty()) {
    worlds.clear();
    for (const std::string& name : a.worlds) {
      const SuiteWorld* const world = suite.find(name);
      if (world == nullptr) stop_with(kBadInput, {"--worlds " + name + ": there is no such world"});
      worlds.push_back(*world);
    }
  }
  const auto protocols = expand_protocols(a.protocols);
  if (!protocols) stop_with(kBadInput, {"--protocols: " + protocols.error().message});
  const std::vector<SuiteReference> known = references(worlds, *protocols);
  const BenchArguments arguments = bench_of(a, worlds, !known.empty());
  std::optional<Stop> stopped;
  try {
    bench(arguments);
  } catch (const Stop& stop) {
    if (stop.status == kBadInput) throw;
    stopped = stop;  // the page shows what there is
  }
  write_suite(a, suite, bench_plan(arguments), known);
  if (stopped) throw Stop(*stopped);
}

}  // namespace canopeer::app
