#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>

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

TEST(BenchCommand, TwoShardsAtOnceLeaveTheWholeComparison) {
  const test::TemporaryDirectory directory;
  const fs::path out = directory / "campaign";
  test::ProgramResult second;
  std::thread other([&] { second = test::canopeer(bench(out, {"--shard", "2/2"})); });
  const auto first = test::canopeer(bench(out, {"--shard", "1/2"}));
  other.join();
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(CsvTable::read(out / "runs.csv")->rows(), 4U);
  EXPECT_NE(read_file(out / "comparison.html").value().find("<p>4 runs."), std::string::npos);
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST(BenchCommand, JoinsWhatTwoMachinesMade) {
  const test::TemporaryDirectory directory;
  const auto one = [&](const fs::path& out, std::vector<std::string> more) {
    std::vector<std::string> words = {
        "bench", "missions/smoke.yaml", "--planners", "vmp,random", "--runs",    "1", "--budgets",
        "2",     "--threads",           "1",          "--out",      out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return test::canopeer(words);
  };
  const fs::path a = directory / "a";
  const fs::path b = directory / "b";
  const fs::path joint = directory / "joint";
  ASSERT_EQ(one(a, {"--shard", "1/2"}).status, 0);
  ASSERT_EQ(one(b, {"--shard", "2/2"}).status, 0);
  const auto merged = one(joint, {"--merge", a.string(), "--merge", b.string()});
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_NE(merged.out.find("2 runs"), std::string::npos) << merged.out;
  EXPECT_EQ(CsvTable::read(joint / "runs.csv")->rows(), 2U);
  EXPECT_NE(read_file(joint / "comparison.html").value().find("2 runs."), std::string::npos);
  // Another version of the program may see something else.
  const fs::path record = "runs/smoke/2s/vmp/seed_1/record";
  ASSERT_TRUE(write_file(a / record, read_file(a / record).value() + "\n").has_value());
  const auto clash = one(joint, {"--merge", a.string()});
  EXPECT_EQ(clash.status, 2);
  EXPECT_NE(clash.err.find("vmp/seed_1: is another run than"), std::string::npos) << clash.err;
  // Under another command, they are others.
  const auto refused =
      one(directory / "other", {"--merge", a.string(), "--set", "graph.neighbors=4"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("seed_1: was made by another command"), std::string::npos);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
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
