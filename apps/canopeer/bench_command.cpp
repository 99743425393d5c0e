#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "canopeer/campaign/comparison_report.h"
#include "canopeer/campaign/comparison_tables.h"
#include "canopeer/campaign/job_pool.h"
#include "commands.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "progress_bar.h"
#include "shipped_data.h"
#include "stop_signal.h"

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

CampaignPlan plan_of(const BenchArguments& a) {
  CampaignPlan plan;
  for (const auto& mission : a.missions) plan.missions.push_back(mission_file_of(mission));
  for (const auto& text : a.planners) {
    const auto contestant = parse_contestant(text);
    if (!contestant) stop_with(kBadInput, {"--planners " + contestant.error().message});
    plan.contestants.push_back(*contestant);
  }
  plan.budgets_s = a.budgets_s;
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
    if (job.budget_s) extra.emplace_back("time_per_segment_s", std::to_string(*job.budget_s));
    static_cast<void>(load(mission, extra));
  }
}

/// The comparison so far; a run that cannot be read is named and left out.
class Collected {
 public:
  Collected(const CampaignPlan& plan, fs::path out) : plan_(plan), out_(std::move(out)) {
    for (const auto& job : all_jobs(plan_)) {
      if (is_done(out_, job)) add(job);
    }
  }

  void add(const CampaignJob& job) {
    auto figures = read_run_figures(out_, job);
    if (figures) {
      runs_.push_back(std::move(*figures));
    } else {
      std::fprintf(stderr, "\ncanopeer: left out: %s\n", figures.error().message.c_str());
    }
  }

  void write() {
    // In the plan's order, whichever run was done first.
    std::vector<RunFigures> ordered;
    for (const auto& job : all_jobs(plan_)) {
      const auto found = std::find_if(runs_.begin(), runs_.end(), [&](const RunFigures& run) {
        return run.job.dir == job.dir;
      });
      if (found != runs_.end()) ordered.push_back(*found);
    }
    value_or_stop(write_comparison(out_, plan_, ordered), kFailed);
    count_ = ordered.size();
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Comparison comparison() const { return compare(plan_, runs_); }

 private:
  const CampaignPlan& plan_;
  fs::path out_;
  std::vector<RunFigures> runs_;
  std::size_t count_ = 0;
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

}  // namespace

void bench(const BenchArguments& arguments) {
  const CampaignPlan plan = plan_of(arguments);
  check_inputs(plan, *arguments.registries);
  const fs::path out = arguments.out;
  std::error_code code;
  fs::create_directories(out, code);
  if (code) stop_with(kFailed, {out.string() + ": cannot be made: " + code.message()});
  Collected collected(plan, out);
  int failed = 0;
  const std::atomic<bool>& stop = catch_stop_signals();
  if (!arguments.report_only) {
    JobPoolOptions options;
    options.program = fs::read_symlink("/proc/self/exe");
    options.out = out;
    options.processes = arguments.jobs;
    options.keep_maps = arguments.keep_maps;
    ProgressBar bar(arguments.quiet);
    const auto show = [&](const CampaignProgress& p) {
      if (p.changed != nullptr && p.state == JobState::done) {
        collected.add(*p.changed);
        collected.write();
      }
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
