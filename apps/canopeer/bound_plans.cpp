#include "bound_plans.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/bounds/clairvoyant.h"
#include "canopeer/bounds/upper_bounds.h"
#include "canopeer/campaign/best_known.h"
#include "canopeer/eval/matching.h"
#include "canopeer/planner/playback/plan_file.h"
#include "canopeer/run/run.h"
#include "exit_status.h"
#include "import_line.h"
#include "mission_arguments.h"
#include "mission_progress.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

/// One of the two plans: what it is best at, and where it and its run lie.
struct PlanJob {
  ClairvoyantOptions::Objective objective = ClairvoyantOptions::Objective::found;
  std::string name;  ///< of the run's folder; the plan is NAME.json beside it
};

/// All that plan and run depend on: a run under the same words is not made again.
std::string words_of(const BoundWorld& world, const ViewPool& pool, const FindRule& rule) {
  return std::string("canopeer ") + CANOPEER_VERSION + "\n" + pool.key + "\nfind area " +
         std::to_string(rule.min_area_cm2) + "\n" + world.file().settings_json + "\n";
}

bool says(const fs::path& file, const std::string& words) {
  const auto before = read_file(file);
  return before && *before == words;
}

ClairvoyantPlan plan_for(const BoundWorld& world, const ViewPool& pool, const FindRule& rule,
                         ClairvoyantOptions::Objective objective,
                         const std::vector<double>& factors, MotionVerdicts& verdicts) {
  ClairvoyantOptions options;
  options.objective = objective;
  options.latency_s = world.file().simulation.sensor.motion.latency_s;
  options.area_factors = factors;
  return value_or_stop(plan_clairvoyant(pool, world.stage->robot().model, *world.judge,
                                        world.file().mission, rule, options, &verdicts),
                       kFailed);
}

/// Of the fruits a plan should find those that its run did not.
std::vector<int> missed(const Run& run, const Scene& scene, const std::vector<int>& promised) {
  std::vector<Vec3> centres;
  for (const FruitEstimate& fruit : run.mission().fruits().fruits())
    centres.push_back(fruit.centre);
  std::set<int> found;
  for (const FruitPair& pair : match_optimal(centres, scene.fruits).pairs) {
    found.insert(scene.fruits[static_cast<std::size_t>(pair.truth)].id);
  }
  std::vector<int> missed;
  std::copy_if(promised.begin(), promised.end(), std::back_inserter(missed),
               [&](int id) { return !found.contains(id); });
  return missed;
}

std::string numbers_text(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += std::to_string(number) + "\n";
  return text;
}

std::vector<int> numbers_in(const std::string& text) {
  std::vector<int> numbers;
  std::istringstream lines(text);
  for (int number = 0; lines >> number;) numbers.push_back(number);
  return numbers;
}

/// How a plan's run ended, and in which segment.
struct Execution {
  std::optional<Summary> summary;  ///< none: before its time, e.g. since there was no way home
  std::size_t segment = 0;
  std::string why;
};

/// By the planner `playback` in the simulator, as any planner's run; leaves `missed.txt`.
Execution execute(const BoundArguments& arguments, const BoundWorld& world, const fs::path& plan,
                  const std::vector<int>& promised, const fs::path& out) {
  Overrides overrides = bound_overrides(arguments);
  overrides.emplace_back("planner", "playback");
  overrides.emplace_back("playback.plan", fs::absolute(plan).string());
  ImportLine line(true);
  StageRequest request = stage_request(arguments.mission, overrides);
  request.threads = arguments.threads;
  request.callbacks = callbacks_for_people(line, true);
  request.callbacks.on_notice = {};  // said when the world was made
  const auto run = value_or_stop(
      Run::compose(load(arguments.mission, overrides), request, *arguments.mission.registries, out),
      kBadInput);
  SignalSteering signals;
  run->steer(signals);
  run->watch(std::make_shared<MissionProgress>(arguments.quiet), {.name = "the progress bar"});
  auto executed = run->execute();
  const auto& segments = run->record().segments;
  const auto last = static_cast<std::size_t>(segments.empty() ? 0 : segments.back().segment);
  if (!run->outcome()) return {std::nullopt, last, run->outcome().error().message};
  Summary summary = value_or_stop(std::move(executed), kFailed);
  if (run->interrupted()) {
    std::fprintf(stderr, "canopeer: interrupted; the same command goes on from what is in %s\n",
                 arguments.out.c_str());
    throw Stop{kInterrupted};
  }
  const std::vector<int> ids = missed(*run, world.scene(), promised);
  value_or_stop(write_file(out / "missed.txt", numbers_text(ids)), kFailed);
  return {std::move(summary), last, ""};
}

/// Until a run comes to its end, its plan is made shorter.
std::optional<Summary> execute_or_shorten(const BoundArguments& arguments, const BoundWorld& world,
                                          const fs::path& file, ClairvoyantPlan& plan,
                                          const fs::path& out) {
  while (true) {
    value_or_stop(write_view_plan(file, plan.plan), kFailed);
    Execution execution = execute(arguments, world, file, plan.fruit_ids, out);
    if (execution.summary) return execution.summary;
    const auto at = shorten(plan.plan, execution.segment);
    if (!at) return std::nullopt;
    std::fprintf(stderr, "canopeer: notice: %s: %s; tried with %zu views in segment %zu\n",
                 file.filename().c_str(), execution.why.c_str(), plan.plan.segments[*at].size(),
                 *at);
  }
}

BestResult result_of(const BoundArguments& arguments, const Summary& summary,
                     const std::string& plan) {
  BestResult best;
  best.detected = summary.detected.value_or(0);
  best.auc = summary.auc.value_or(0.0);
  best.planner = "clairvoyant";
  best.version = summary.canopeer_version;
  best.seed = summary.seed;
  best.plan = plan;
  best.settings = arguments.mission.settings;
  if (arguments.segments) {
    best.settings.push_back("max_segments=" + std::to_string(*arguments.segments));
  }
  return best;
}

/// A plan executed, and what of its promise was missed.
struct Executed {
  BestResult result;
  std::vector<int> missed;
};

std::optional<Executed> make(const BoundArguments& arguments, const BoundWorld& world,
                             const ViewPool& pool, const FindRule& rule, const PlanJob& job,
                             const std::vector<double>& factors, MotionVerdicts& verdicts) {
  const fs::path out = fs::path(arguments.out) / job.name;
  const std::string plan_name = job.name + ".json";
  std::string words = words_of(world, pool, rule);
  for (const double factor : factors) words += " " + std::to_string(factor);
  const fs::path no_end = out / "came_to_no_end.txt";
  Summary summary;
  if (says(out / "made_of.txt", words) && fs::exists(out / "summary.json")) {
    summary = value_or_stop(read_summary(out / "summary.json"), kFailed);
  } else if (says(no_end, words)) {
    return std::nullopt;
  } else {
    ClairvoyantPlan plan = plan_for(world, pool, rule, job.objective, factors, verdicts);
    const fs::path plan_path = fs::path(arguments.out) / plan_name;
    const auto executed = execute_or_shorten(arguments, world, plan_path, plan, out);
    if (!executed) {
      value_or_stop(write_file(no_end, words), kFailed);
      return std::nullopt;
    }
    summary = *executed;
    value_or_stop(write_file(out / "made_of.txt", words), kFailed);
  }
  return Executed{result_of(arguments, summary, plan_name),
                  numbers_in(value_or_stop(read_file(out / "missed.txt"), kFailed))};
}

/// Which pixels become a fruit is known only when they are fused. So the plan is executed, and of
/// fruits that were missed more is wanted to be seen, a few times over. All results.
std::vector<BestResult> rounds_of(const BoundArguments& arguments, const BoundWorld& world,
                                  const ViewPool& pool, const FindRule& rule, const PlanJob& job,
                                  MotionVerdicts& verdicts) {
  constexpr int kRounds = 3;
  constexpr double kMore = 2.0;
  std::vector<double> factors(world.scene().fruits.size(), 1.0);
  std::vector<BestResult> results;
  for (int round = 1; round <= kRounds; ++round) {
    const PlanJob one{job.objective, job.name + "_" + std::to_string(round)};
    const auto executed = make(arguments, world, pool, rule, one, factors, verdicts);
    if (!executed) {
      std::fprintf(stderr,
                   "canopeer: notice: %s.json does not count: its run ended before its time\n",
                   one.name.c_str());
      break;
    }
    results.push_back(executed->result);
    if (executed->missed.empty()) break;
    for (const int id : executed->missed) factors[static_cast<std::size_t>(id)] *= kMore;
  }
  return results;
}

}  // namespace

void add_clairvoyant(const BoundArguments& arguments, const BoundWorld& world, const ViewPool& pool,
                     BoundResults& results) {
  using Objective = ClairvoyantOptions::Objective;
  MotionVerdicts verdicts;
  const auto by = [&](Objective objective, const char* name) {
    return rounds_of(arguments, world, pool, results.plan_rule, {objective, name}, verdicts);
  };
  std::vector<BestResult> all = by(Objective::found, "clairvoyant_found");
  for (BestResult& one : by(Objective::auc, "clairvoyant_auc")) all.push_back(std::move(one));
  if (all.empty()) return;
  Yardstick& y = results.yardstick;
  y.best_found = *std::max_element(all.begin(), all.end(),
                                   [](const auto& a, const auto& b) { return finds_more(b, a); });
  y.best_auc = *std::max_element(all.begin(), all.end(),
                                 [](const auto& a, const auto& b) { return a.auc < b.auc; });
  y.clairvoyant = y.best_auc;
}

void add_upper_bounds(const BoundWorld& world, const ViewPool& pool, BoundResults& results) {
  const RobotModel& robot = world.stage->robot().model;
  const MissionOptions& mission = world.file().mission;
  results.yardstick.sampled = sampled_bound(pool, robot, mission, results.rule);
  results.yardstick.certified =
      certified_bound(world.scene(), robot, mission, world.file().simulation.camera);
}

}  // namespace canopeer::app
