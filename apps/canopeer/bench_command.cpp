#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>
#include <vector>

#include "canopeer/campaign/campaign_merge.h"
#include "canopeer/campaign/comparison_report.h"
#include "canopeer/campaign/comparison_tables.h"
#include "canopeer/campaign/job_pool.h"
#include "canopeer/config/protocols.h"
#include "commands.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "progress_bar.h"
#include "records.h"
#include "shipped_data.h"
#include "stop_signal.h"
#include "suite_command.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

void read_shard(const std::string& text, CampaignPlan& plan) {
  int used = 0;
  if (std::sscanf(text.c_str(), "%d/%d%n", &plan.shard, &plan.shards, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size()) {
    stop_with(kBadInput, {"--shard " + text + ": expected i/n, e.g. 1/4"});
  }
}

}  // namespace

CampaignPlan bench_plan(const BenchArguments& a) {
  CampaignPlan plan;
  for (const auto& mission : a.missions) plan.missions.push_back(mission_file_of(mission));
  for (const auto& text : a.planners) {
    const auto contestant = parse_contestant(text);
    if (!contestant) stop_with(kBadInput, {"--planners " + contestant.error().message});
    plan.contestants.push_back(*contestant);
  }
  plan.budgets_s = a.budgets_s;
  const auto protocols = expand_protocols(a.protocols);
  if (!protocols) stop_with(kBadInput, {"--protocols: " + protocols.error().message});
  plan.protocols = *protocols;
  plan.yardsticks = a.yardsticks;
  plan.runs = a.runs;
  plan.first_seed = a.first_seed;
  plan.segments = a.segments;
  plan.settings = a.settings;
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  plan.threads = a.threads > 0 ? a.threads : std::max(1, static_cast<int>(cores) / a.jobs);
  if (!a.shard.empty()) read_shard(a.shard, plan);
  if (auto ok = validate(plan); !ok) stop_with(kBadInput, ok.error());
  return plan;
}

namespace {

/// Who asks for yardsticks wants to see some.
void check_yardsticks(const CampaignPlan& plan) {
  if (plan.yardsticks.empty()) return;
  const auto jobs = all_jobs(plan);
  const bool any = std::any_of(jobs.begin(), jobs.end(), [&](const CampaignJob& job) {
    return !yardstick_of(plan, job).empty();
  });
  if (any) return;
  const CampaignJob& first = jobs.front();
  stop_with(kBadInput, {"--yardsticks " + plan.yardsticks.string() +
                        ": holds none of these missions and rules; expected e.g. " +
                        first.mission_name + "/seed_" + std::to_string(first.seed) + "/" +
                        (first.protocol.empty() ? "own" : first.protocol) + ".json in it" +
                        (plan.budgets_s.empty() ? "" : ", and --protocols in place of --budgets")});
}

/// Who makes no runs wants to see those that are there. None yet is no fault: a campaign on a
/// cluster begins so.
void tell_when_empty(const CampaignPlan& plan, const fs::path& out) {
  const auto jobs = all_jobs(plan);
  const bool any = std::any_of(jobs.begin(), jobs.end(),
                               [&](const CampaignJob& job) { return is_done(out, job); });
  if (any) return;
  std::fprintf(stderr, "canopeer: %s holds no run of this comparison yet, such as %s\n",
               out.c_str(), jobs.front().dir.c_str());
}

/// Every mission with every planner must load, before hours are spent on the others.
void check_inputs(const CampaignPlan& plan, const RunRegistries& registries) {
  for (const auto& job : all_jobs(plan)) {
    if (job.seed != plan.first_seed) break;
    MissionArguments mission;
    mission.registries = &registries;
    mission.path = job.mission.string();
    mission.settings = plan.settings;
    Overrides extra = {{"planner", job.contestant.planner}};
    if (!job.contestant.table.empty()) extra.emplace_back("compute_table", job.contestant.table);
    if (!job.protocol.empty()) extra.emplace_back("protocol", job.protocol);
    if (job.budget_s) extra.emplace_back("time_per_segment_s", std::to_string(*job.budget_s));
    static_cast<void>(load(mission, extra));
  }
}

/// The comparison so far; a run that cannot be read is named and left out.
class Collected {
 public:
  Collected(const CampaignPlan& plan, fs::path out)
      : plan_(plan), out_(std::move(out)), jobs_(all_jobs(plan)), seen_(jobs_.size()) {}

  /// Runs that other processes make in the same folder are in it. Whoever writes last has seen all
  /// that were there before it, so the last of several leaves the whole comparison.
  void write() {
    look();
    do {
      value_or_stop(write_comparison(out_, plan_, runs()), kFailed);
    } while (look());
  }
  /// In the plan's order, whichever run was done first.
  [[nodiscard]] std::vector<RunFigures> runs() const {
    std::vector<RunFigures> all;
    for (const auto& run : seen_) {
      if (run.figures) all.push_back(*run.figures);
    }
    return all;
  }
  [[nodiscard]] Comparison comparison() const { return compare(plan_, runs()); }

 private:
  /// Reads the runs that have come since; false when there is none.
  bool look() {
    bool any = false;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (seen_[i].there || !is_done(out_, jobs_[i])) continue;
      seen_[i].there = any = true;
      auto figures = read_run_figures(out_, jobs_[i], yardstick_of(plan_, jobs_[i]));
      if (figures) {
        seen_[i].figures = std::move(*figures);
      } else {
        std::fprintf(stderr, "\ncanopeer: left out: %s\n", figures.error().message.c_str());
      }
    }
    return any;
  }

  struct Seen {
    bool there = false;
    std::optional<RunFigures> figures;
  };
  const CampaignPlan& plan_;
  fs::path out_;
  std::vector<CampaignJob> jobs_;
  std::vector<Seen> seen_;  ///< parallel to jobs_
};

std::string line_of(const CampaignProgress& p) {
  char text[160];
  std::snprintf(text, sizeof text, "%d of %d runs done, %d under way%s", p.done, p.jobs, p.running,
                p.failed > 0 ? (", " + std::to_string(p.failed) + " failed").c_str() : "");
  return text;
}

void print_comparison(const Comparison& comparison, const fs::path& out) {
  const std::size_t paper = figure_index("detected_paper");
  const std::size_t strict = figure_index("detected");
  for (const auto& match : comparison.matches) {
    std::printf("%s (%d fruits)\n", match.title().c_str(), match.fruits_total);
    for (const auto& c : match.contestants) {
      std::printf("  %-24s n = %-3zu found %s at 0.20 m, %s at 0.05 m\n", c.label.c_str(),
                  c.runs.size(), mean_text(c.figures[paper], 1).c_str(),
                  mean_text(c.figures[strict], 1).c_str());
    }
  }
  std::printf("comparison  %s\n", (out / "comparison.html").c_str());
}

/// What others have made, before it is compared.
void join(const BenchArguments& arguments, const CampaignPlan& plan) {
  const std::vector<fs::path> parts(arguments.merge.begin(), arguments.merge.end());
  const auto outcome = value_or_stop(merge_campaigns(plan, parts, arguments.out), kBadInput);
  if (outcome.strangers > 0) {
    std::fprintf(stderr, "canopeer: %d runs of other campaigns were left where they are\n",
                 outcome.strangers);
  }
  if (!arguments.quiet) {
    std::printf("merged      %d runs, %d were there already\n", outcome.taken, outcome.twice);
  }
}

}  // namespace

void bench(const BenchArguments& arguments) {
  const CampaignPlan plan = bench_plan(arguments);
  check_yardsticks(plan);
  check_inputs(plan, *arguments.registries);
  const fs::path out = arguments.out;
  if (arguments.report_only && (!arguments.quiet || arguments.progress)) tell_when_empty(plan, out);
  std::error_code code;
  fs::create_directories(out, code);
  if (code) stop_with(kFailed, {out.string() + ": cannot be made: " + code.message()});
  Collected collected(plan, out);
  int failed = 0;
  const std::atomic<bool>& stop = catch_stop_signals();
  if (!arguments.merge.empty()) join(arguments, plan);
  if (!arguments.report_only && arguments.merge.empty()) {
    JobPoolOptions options;
    options.program = fs::read_symlink("/proc/self/exe");
    options.out = out;
    options.processes = arguments.jobs;
    options.keep_maps = arguments.keep_maps;
    ProgressBar bar(arguments.quiet && !arguments.progress);
    const auto show = [&](const CampaignProgress& p) {
      if (p.changed != nullptr && p.state == JobState::done) collected.write();
      if (p.changed != nullptr && p.state == JobState::failed) {
        std::fprintf(stderr, "\ncanopeer: %s failed: %s\n", p.changed->dir.c_str(),
                     p.message.c_str());
      }
      failed = p.failed;
      bar.show(static_cast<double>(p.done) / std::max(1, p.jobs), line_of(p), p.done);
    };
    const auto outcome = run_jobs(plan, options, stop, show);
    bar.finish();
    if (!outcome) stop_with(kBadInput, outcome.error());
  }
  collected.write();
  if (plan.settings.empty() && !plan.segments) {
    keep_improvements(out, collected.runs(), mission_record_of, arguments.quiet);
  }
  if (!arguments.quiet) print_comparison(collected.comparison(), out);
  if (stop) {
    std::fprintf(stderr, "canopeer: interrupted; the same command goes on from here\n");
    throw Stop{kInterrupted};
  }
  if (failed > 0) {
    stop_with(kFailed, {std::to_string(failed) + " runs failed; their output is in " +
                        (out / "runs").string() + ", *.log"});
  }
}

}  // namespace canopeer::app
