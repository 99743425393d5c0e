#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/suite_results.h"
#include "canopeer/record/yardstick.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> suite(const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"bench",      "suite",
                                    "--planners", "random,coverage",
                                    "--worlds",   "sparse_1_clean_a",
                                    "--seeds",    "1",
                                    "--threads",  "1",
                                    "--out",      out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// What ships with the program but for its records, as long as it lives.
class WithoutRecords {
 public:
  WithoutRecords() {
    fs::create_directory(directory_ / "data");
    for (const auto& entry : fs::directory_iterator(CANOPEER_SOURCE_DIR)) {
      if (!entry.is_directory() || entry.path().filename() == "records") continue;
      fs::create_directory_symlink(entry, directory_ / "data" / entry.path().filename());
    }
    setenv("CANOPEER_DATA", (directory_ / "data").c_str(), 1);
  }
  ~WithoutRecords() { unsetenv("CANOPEER_DATA"); }
  WithoutRecords(const WithoutRecords&) = delete;
  WithoutRecords& operator=(const WithoutRecords&) = delete;

 private:
  test::TemporaryDirectory directory_;
};

/// The tiny suite: one world, two planners; made, resumed, handed in, its record verified.
TEST(SuiteCommand, RunsIsResumedAndSaysWhatIsHandedIn) {
  const WithoutRecords data;
  const test::TemporaryDirectory directory;
  const fs::path out = directory / "suite";
  const auto half = test::canopeer(suite(out, {"--shard", "1/2"}));
  ASSERT_EQ(half.status, 0) << half.err;
  const fs::path first = out / "runs/sparse_1_clean_a/tight10/random/seed_1/summary.json";
  ASSERT_TRUE(fs::exists(first));
  const auto written = fs::last_write_time(first);
  const auto whole = test::canopeer(suite(out));
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(fs::last_write_time(first), written);
  EXPECT_NE(whole.out.find("coverage"), std::string::npos) << whole.out;
  for (const char* file : {"suite.html", "results.json", "results.csv", "comparison.html"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
  // One world is no whole split: said so, and nothing else is wrong.
  const auto check = test::canopeer({"bench", "suite", "--check", (out / "results.json").string()});
  EXPECT_EQ(check.status, 1);
  EXPECT_NE(check.err.find("not complete"), std::string::npos) << check.err;
  EXPECT_EQ(check.err.find("figures"), std::string::npos) << check.err;

  // The best of the two is a record, and comes out again to the digit.
  const fs::path record = out / "records/suite/sparse_1_clean_a/tight10.json";
  auto yardstick = read_yardstick(record);
  ASSERT_TRUE(yardstick.has_value()) << yardstick.error().message;
  ASSERT_TRUE(yardstick->best_found.has_value());
  EXPECT_GT(yardstick->best_found->detected, 0);
  const auto good = test::canopeer({"bench", "--verify-records", (out / "records").string()});
  EXPECT_EQ(good.status, 0) << good.err << good.out;
  yardstick->best_auc->auc += 1e-9;
  ASSERT_TRUE(write_yardstick(record, *yardstick).has_value());
  const auto bad = test::canopeer({"bench", "--verify-records", (out / "records").string()});
  EXPECT_EQ(bad.status, 1);
  EXPECT_NE(bad.out.find("NOT the same"), std::string::npos) << bad.out;
}

/// Its own references are anybody's claim.
TEST(SuiteCommand, AnEntryIsScoredByTodaysRecords) {
  const test::TemporaryDirectory directory;
  const Suite suite = load_suite(fs::path(CANOPEER_SOURCE_DIR) / "benchmark").value();
  SuiteResults entry;
  entry.suite_version = suite.version;
  entry.suite_sha256 = suite.sha256;
  entry.split = "test";
  for (const SuiteWorld& world : suite.worlds) {
    if (world.split != "test") continue;
    SuiteRun run;
    run.world = world.name;
    run.protocol = "tight10";
    run.planner = "mine";
    run.fruits_total = world.fruits_counted;
    run.auc = 0.25;
    entry.runs.push_back(run);
    entry.references.push_back({world.name, run.protocol, 0.25, "mine"});
  }
  entry.scores = suite_scores(entry.runs, entry.references);
  EXPECT_EQ(entry.scores.at(0).value.mean, 1.0);
  const fs::path file = directory / "results.json";
  ASSERT_TRUE(write_file(file, suite_results_json(entry)));
  const auto check = test::canopeer({"bench", "suite", "--check", file.string()});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_NE(check.out.find("a valid entry, 12 runs"), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("normalised by other records"), std::string::npos) << check.out;
  EXPECT_EQ(check.out.find("1.000"), std::string::npos) << check.out;
}

TEST(SuiteCommand, RefusesWhatIsWrongBeforeItRunsAnything) {
  const test::TemporaryDirectory directory;
  const fs::path out = directory / "suite";
  for (const auto& [more, named] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--protocols", "tight11"}, "tight11"},
           {{"--planners", "vpm"}, "vpm"},
           {{"--worlds", "nowhere"}, "nowhere"}}) {
    const auto result = test::canopeer(suite(out, more));
    EXPECT_EQ(result.status, 2) << named;
    EXPECT_NE(result.err.find(named), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(out / "runs")) << named;
  }
  EXPECT_EQ(test::canopeer({"bench", "suite"}).status, 2);
  // No runs yet are no fault, but a word.
  const auto none = test::canopeer(suite(out, {"--report-only"}));
  EXPECT_EQ(none.status, 0);
  EXPECT_NE(none.err.find("holds no run"), std::string::npos) << none.err;
  EXPECT_EQ(test::canopeer({"bench"}).status, 2);
}

TEST(SceneFreeze, AFrozenSceneIsTheSameWorldEverywhere) {
  const test::TemporaryDirectory directory;
  const fs::path file = directory / "row.cscene";
  const auto frozen = test::canopeer(
      {"scene", "freeze", "missions/smoke.yaml", "--seed", "5", "--out", file.string()});
  ASSERT_EQ(frozen.status, 0) << frozen.err;
  EXPECT_TRUE(fs::exists(directory / "row.truth.csv"));
  const auto look = test::canopeer({"scene", "inspect", file.string(), "--counts"});
  ASSERT_EQ(look.status, 0) << look.err;
  EXPECT_NE(look.out.find("row, seed 5"), std::string::npos) << look.out;
  // Frozen once more it is the same file.
  const fs::path again = directory / "again/row.cscene";
  ASSERT_EQ(
      test::canopeer({"scene", "freeze", file.string(), "--seed", "5", "--out", again.string()})
          .status,
      0);
  EXPECT_EQ(*read_file(again), *read_file(file));
  ASSERT_TRUE(write_file(file, read_file(file)->substr(0, 1000)).has_value());
  const auto cut = test::canopeer({"scene", "inspect", file.string(), "--counts"});
  EXPECT_EQ(cut.status, 2);
  EXPECT_NE(cut.err.find("row.cscene"), std::string::npos) << cut.err;
}

}  // namespace
}  // namespace canopeer
