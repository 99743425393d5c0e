#include "canopeer/campaign/comparison.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/csv_table.h"
#include "canopeer/campaign/comparison_report.h"
#include "canopeer/campaign/comparison_tables.h"
#include "canopeer/record/yardstick_shares.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// A run that found `found` of 47 fruits, one every 10 s.
RunFigures made_up_run(const CampaignJob& job, int found) {
  RunFigures run;
  run.job = job;
  run.fruits_total = 47;
  run.planned_s = 480.0;
  run.values.resize(figures().size());
  run.values[figure_index("detected_paper")] = found;
  run.values[figure_index("auc")] = found / 60.0;
  for (int i = 1; i <= found; ++i) run.found.push_back({10.0 * i, i, i - 1});
  for (int i = 0; i < 20; ++i) run.intervals_s.push_back(1.0 + 0.1 * i * found / 40.0);
  if (job.contestant.planner == "vmp") {
    for (int i = 1; i < 50; ++i) run.gains.emplace_back(i * 100.0, i * 90.0 + found);
  }
  return run;
}

struct Made {
  CampaignPlan plan;
  std::vector<RunFigures> runs;
};

Made made_up_campaign() {
  Made made;
  made.plan.missions = {"scenario_1.yaml"};
  made.plan.contestants = {{"vmp", ""}, {"vmp_released", "reference"}, {"rvp", ""}};
  made.plan.budgets_s = {10, 60};
  made.plan.runs = 5;
  for (const auto& job : all_jobs(made.plan)) {
    const int lead = job.contestant.planner == "vmp" ? 3 : 0;
    const int late = *job.budget_s > 30 ? 10 : 0;
    made.runs.push_back(made_up_run(job, 28 + lead + late + static_cast<int>(job.seed % 3)));
  }
  return made;
}

TEST(Comparison, SumsUpRunsByMissionBudgetAndPlannerAndPairsThemBySeed) {
  const Made made = made_up_campaign();
  const Comparison comparison = compare(made.plan, made.runs);
  ASSERT_EQ(comparison.matches.size(), 2U);
  const Match& match = comparison.matches[1];
  EXPECT_EQ(match.title(), "scenario_1, 60 s per segment");
  ASSERT_EQ(match.contestants.size(), 3U);
  const std::size_t figure = figure_index("detected_paper");
  EXPECT_EQ(match.contestants[0].figures[figure].count, 5U);
  EXPECT_NEAR(match.contestants[0].figures[figure].mean, 42.2 - 0.2, 0.3);
  ASSERT_EQ(match.against_first.size(), 2U);
  const PairedFigures& rvp = match.against_first[1].figures[figure];
  EXPECT_EQ(rvp.difference.count, 5U);
  EXPECT_DOUBLE_EQ(rvp.difference.mean, -3.0);
  EXPECT_DOUBLE_EQ(rvp.p_wilcoxon.value(), 2.0 / 32.0);
}

TEST(Comparison, UsesWhatIsThereOfACampaignThatIsNotDone) {
  Made made = made_up_campaign();
  // Of rvp at 60 s only seed 2 is there, of vmp_released nothing.
  std::erase_if(made.runs, [](const RunFigures& run) {
    const auto& job = run.job;
    return *job.budget_s > 30 && (job.contestant.planner == "vmp_released" ||
                                  (job.contestant.planner == "rvp" && job.seed != 2));
  });
  const Comparison comparison = compare(made.plan, made.runs);
  EXPECT_LT(comparison.runs_there, comparison.runs_planned);
  const Match& match = comparison.matches[1];
  ASSERT_EQ(match.contestants.size(), 2U);
  const PairedFigures& pair = match.against_first[0].figures[figure_index("detected_paper")];
  EXPECT_EQ(pair.difference.count, 1U);
  EXPECT_FALSE(pair.p_wilcoxon.has_value());
}

TEST(Comparison, IsByProtocolAndLeavesOutWhatNobodyHas) {
  Made made;
  made.plan.missions = {"scenario_1.yaml"};
  made.plan.contestants = {{"vmp", ""}, {"rvp", ""}};
  made.plan.protocols = {"tight10", "views10"};
  made.plan.runs = 3;
  for (const auto& job : all_jobs(made.plan)) {
    made.runs.push_back(made_up_run(job, job.protocol == "tight10" ? 20 : 30));
    if (job.protocol == "views10") made.runs.back().values[figure_index("auc_views")] = 0.5;
  }
  const Comparison comparison = compare(made.plan, made.runs);
  ASSERT_EQ(comparison.matches.size(), 2U);
  EXPECT_EQ(comparison.matches[0].title(), "scenario_1, protocol tight10");
  const std::size_t found = figure_index("detected_paper");
  EXPECT_EQ(comparison.matches[0].contestants[0].figures[found].mean, 20.0);
  EXPECT_EQ(comparison.matches[1].contestants[0].figures[found].mean, 30.0);
  const std::size_t views = figure_index("auc_views");
  EXPECT_FALSE(comparison.matches[0].anybody_has(views));
  EXPECT_TRUE(comparison.matches[1].anybody_has(views));
  const std::string markdown = comparison_markdown(comparison);
  EXPECT_NE(markdown.find("## scenario_1, protocol views10"), std::string::npos);
  EXPECT_EQ(markdown.find("clairvoyant"), std::string::npos);
  EXPECT_NE(runs_csv(made.runs).find(",views10\n"), std::string::npos);
  EXPECT_NE(comparison_csv(comparison).find(",tight10\n"), std::string::npos);
}

/// Two segments with a transition between them, a view in each, a frame on the way between.
RunFiles made_up_files(double mission_time_s) {
  RunFiles files;
  files.record.header.mission_time_s = mission_time_s;
  files.record.segments = {{0, "one", 0.0, 10.0, Box(), Box()},
                           {1, "two", 14.0, 24.0, Box(), Box()}};
  for (const int i : {0, 1}) {
    FruitTruth truth;
    truth.centre = {1.0 * i, 0.0, 1.0};
    truth.counted = true;
    files.truth.push_back(truth);
  }
  files.record.views.resize(2);
  files.record.views[0].t_s = 2.0;
  files.record.views[1].t_s = 16.0;
  files.record.views[1].segment = 1;
  files.record.views[1].view = 1;
  files.record.frames.resize(1);
  files.record.frames[0].view = 1;
  files.record.frames[0].t_s = 12.0;
  files.record.frames[0].fruits = {{0, files.truth[0].centre, 100.0, 1.0}};
  files.record.views[1].fruits = files.record.frames[0].fruits;
  files.record.views[1].fruits.push_back({1, files.truth[1].centre, 100.0, 1.0});
  files.record.end_s = 25.0;
  files.summary.planning_time_s = 6.0;
  return files;
}

TEST(RunFigures, CountOverTheMissionsClock) {
  RunFiles files = made_up_files(30.0);
  files.summary.mission_time_s = 30.0;
  files.summary.frames_fused = 7;
  files.summary.frames_late = 2;
  files.summary.frames_blurred = 3;
  const RunFigures run = run_figures({}, files);
  EXPECT_TRUE(run.one_clock);
  EXPECT_EQ(run.planned_s, 30.0);
  ASSERT_EQ(run.found.size(), 3U);
  EXPECT_EQ(run.found[1].t_s, 12.0);  // on the way: found then
  EXPECT_EQ(run.found[1].strict, 1);
  EXPECT_EQ(run.found[2].t_s, 16.0);
  EXPECT_EQ(run.found[2].strict, 2);
  EXPECT_EQ(run.values[figure_index("mission_time_s")], 30.0);
  EXPECT_EQ(run.values[figure_index("frames_fused")], 7.0);
  EXPECT_EQ(run.values[figure_index("frames_late")], 2.0);
  EXPECT_EQ(run.values[figure_index("frames_blurred")], 3.0);
  EXPECT_EQ(run.values[figure_index("still_share")], 0.2);
}

TEST(RunFigures, AreHeldAgainstAYardstick) {
  RunFiles files = made_up_files(30.0);
  files.summary.detected = 2;
  files.summary.time = TimeSplit{1.0, 2.0, 3.0, 4.0, 5.0};
  Yardstick yardstick;
  yardstick.ceiling_fruits = 4;
  hold_against(yardstick, files.summary);
  const RunFigures run = run_figures({}, files);
  EXPECT_EQ(run.values[figure_index("ceiling_fruits_share")], 0.5);
  EXPECT_FALSE(run.values[figure_index("best_found_share")].has_value());
  EXPECT_EQ(run.values[figure_index("time_transitions_s")], 5.0);
}

TEST(RunFigures, LeaveTransitionsOutByThePapersClock) {
  const RunFigures run = run_figures({}, made_up_files(0.0));
  EXPECT_FALSE(run.one_clock);
  EXPECT_EQ(run.planned_s, 20.0);
  EXPECT_EQ(run.found[2].t_s, 12.0);
  EXPECT_FALSE(run.values[figure_index("mission_time_s")].has_value());
  EXPECT_FALSE(run.values[figure_index("frames_fused")].has_value());
}

TEST(Comparison, TextsOfFigures) {
  SampleFigures f;
  EXPECT_EQ(mean_text(f, 1), "–");
  f = {.count = 5, .mean = 39.2, .standard_deviation = 1.9, .low95 = 37.64, .high95 = 40.8};
  EXPECT_EQ(mean_text(f, 1), "39.2 ± 1.9");
  EXPECT_EQ(interval_text(f, 1), "37.6 … 40.8");
  EXPECT_EQ(p_text(0.0004), "< 0.001");
  EXPECT_EQ(p_text(0.0625), "0.062");
  EXPECT_EQ(p_text(std::nullopt), "–");
}

TEST(Comparison, WritesAPageTablesAndPlots) {
  const fs::path out = fs::temp_directory_path() / "canopeer_comparison_WritesAPageTablesAndPlots";
  fs::remove_all(out);
  fs::create_directories(out);
  const Made made = made_up_campaign();
  ASSERT_TRUE(write_comparison(out, made.plan, made.runs).has_value());
  const auto runs = CsvTable::read(out / "runs.csv");
  ASSERT_TRUE(runs.has_value());
  EXPECT_EQ(runs->rows(), made.runs.size());
  const auto table = CsvTable::read(out / "comparison.csv");
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->rows(), 2U * 3U * figures().size());
  EXPECT_NE(read_file(out / "comparison.md")->find("| fruits found, 0.20 m |"), std::string::npos);
  EXPECT_NE(read_file(out / "comparison.html")->find("Planners compared"), std::string::npos);
  for (const char* name : {"scenario_1_60s_found", "scenario_1_60s_intervals",
                           "scenario_1_60s_gains", "scenario_1_budgets"}) {
    tinyxml2::XMLDocument svg;
    EXPECT_EQ(svg.LoadFile((out / "plots" / (std::string(name) + ".svg")).c_str()),
              tinyxml2::XML_SUCCESS)
        << name;
  }
  const std::string first = read_file(out / "comparison.html").value();
  ASSERT_TRUE(write_comparison(out, made.plan, made.runs).has_value());
  EXPECT_EQ(read_file(out / "comparison.html").value(), first);
  fs::remove_all(out);
}

}  // namespace
}  // namespace canopeer
