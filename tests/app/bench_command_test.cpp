#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/csv_table.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> bench(const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {
      "bench", "missions/smoke.yaml", "--planners", "vmp,random", "--runs",    "2", "--budgets",
      "2",     "--threads",           "1",          "--out",      out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(BenchCommand, ComparesPlannersAndGoesOnWhereItWas) {
  const test::TemporaryDirectory directory;
  const fs::path out = directory / "campaign";
  // Half of it as one of two machines would, then the rest.
  const auto half = test::canopeer(bench(out, {"--shard", "1/2"}));
  ASSERT_EQ(half.status, 0) << half.err;
  const auto first = fs::last_write_time(out / "runs/smoke/2s/vmp/seed_1/summary.json");
  EXPECT_FALSE(fs::exists(out / "runs/smoke/2s/random"));
  const auto whole = test::canopeer(bench(out));
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(fs::last_write_time(out / "runs/smoke/2s/vmp/seed_1/summary.json"), first);
  EXPECT_NE(whole.out.find("random"), std::string::npos);
  const auto runs = CsvTable::read(out / "runs.csv");
  ASSERT_TRUE(runs.has_value());
  EXPECT_EQ(runs->rows(), 4U);
  EXPECT_EQ(runs->text(0, "planner").value(), "vmp");
  for (const char* file : {"comparison.html", "comparison.md", "comparison.csv",
                           "plots/smoke_2s_found.svg", "plots/smoke_2s_intervals.svg"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
  // Other settings are another campaign.
  const auto other = test::canopeer(bench(out, {"--set", "graph.neighbors=4"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("another command"), std::string::npos);
}

TEST(BenchCommand, RefusesWhatItCannotRunBeforeItRunsAnything) {
  const test::TemporaryDirectory directory;
  const fs::path out = directory / "campaign";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"bench", "missions/smoke.yaml", "--planners", "vmp,vpm", "--out", out.string()}, "vpm"},
      {{"bench", "missions/none.yaml", "--out", out.string()}, "none.yaml"},
      {{"bench", "missions/smoke.yaml", "--planners", "vmp@nowhere", "--out", out.string()},
       "nowhere"},
      {{"bench", "missions/smoke.yaml", "--shard", "3/2", "--out", out.string()}, "3/2"},
      {{"bench", "missions/smoke.yaml", "--planners", "rvp,rvp", "--out", out.string()}, "twice"},
  };
  for (const auto& [words, named] : cases) {
    const auto result = test::canopeer(words);
    EXPECT_EQ(result.status, 2) << named;
    EXPECT_NE(result.err.find(named), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(out / "runs")) << named;
  }
}

TEST(RunCommand, EveryPlannerWorksThroughASegment) {
  const test::TemporaryDirectory directory;
  for (const char* planner : {"vmp_released", "rvp", "coverage"}) {
    const fs::path out = directory / planner;
    const auto result =
        test::canopeer({"run", "missions/smoke.yaml", "--planner", planner, "--time-per-segment",
                        "12", "--threads", "1", "--out", out.string()});
    ASSERT_EQ(result.status, 0) << planner << ": " << result.err;
    const auto timeline = CsvTable::read(out / "timeline.csv");
    ASSERT_TRUE(timeline.has_value());
    EXPECT_GE(timeline->rows(), 2U) << planner;
  }
}

}  // namespace
}  // namespace canopeer
