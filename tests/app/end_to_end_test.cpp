#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::string summary_without_wall_time(const fs::path& run) {
  const auto text = read_file(run / "summary.json");
  EXPECT_TRUE(text.has_value());
  return std::regex_replace(text.value_or(""), std::regex("\"wall_time_s\": [^,\\n]*"), "");
}

double figure(const std::string& summary, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(summary, match, std::regex("\"" + name + "\": (-?[0-9.e+-]+)"))) {
    ADD_FAILURE() << name << " is not in the summary";
    return 0.0;
  }
  return std::stod(match[1]);
}

TEST(SmokeMission, GivesTheSameResultsAtOneAndTwoThreads) {
  const test::TemporaryDirectory directory;
  const auto one = directory / "one";
  const auto two = directory / "two";
  const auto first =
      test::canopeer({"run", "missions/smoke.yaml", "--threads", "1", "--out", one.string()});
  ASSERT_EQ(first.status, 0) << first.err;
  const auto second =
      test::canopeer({"run", "missions/smoke.yaml", "--threads", "2", "--out", two.string()});
  ASSERT_EQ(second.status, 0) << second.err;

  const std::string summary = summary_without_wall_time(one);
  EXPECT_EQ(summary, summary_without_wall_time(two));
  for (const char* file :
       {"record", "timeline.csv", "fruits.csv", "fruits.json", "fruits.ply", "fruits.glb", "map.ot",
        "map_roi.ot", "ground_truth.csv", "pictures/01_row.png"}) {
    const auto a = read_file(one / file);
    const auto b = read_file(two / file);
    ASSERT_TRUE(a.has_value() && b.has_value()) << file;
    EXPECT_TRUE(*a == *b) << file << " differs between 1 and 2 threads";
    EXPECT_FALSE(a->empty()) << file;
  }
  EXPECT_TRUE(fs::exists(one / "report.html"));

  // It did what it is there for.
  EXPECT_GE(figure(summary, "views"), 5);
  EXPECT_EQ(figure(summary, "fruits_total"), 47);
  EXPECT_GE(figure(summary, "detected"), 3);
  EXPECT_EQ(figure(summary, "collisions"), 0);
}

TEST(SmokeMission, AnotherSeedGivesAnotherRun) {
  const test::TemporaryDirectory directory;
  const auto run = [&](const std::string& seed) {
    const auto out = directory / ("seed" + seed);
    const auto result =
        test::canopeer({"run", "missions/smoke.yaml", "--seed", seed, "--time-per-segment", "3",
                        "--quiet", "--out", out.string()});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.out.empty());
    return read_file(out / "ground_truth.csv").value_or("");
  };
  EXPECT_NE(run("2"), run("3"));
}

TEST(ReportCommand, MakesTheSameReportAnew) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "run";
  ASSERT_EQ(test::canopeer({"run", "missions/smoke.yaml", "--time-per-segment", "2", "--quiet",
                            "--out", out.string()})
                .status,
            0);
  const auto before = read_file(out / "report.html");
  fs::remove(out / "report.html");
  ASSERT_EQ(test::canopeer({"report", out.string()}).status, 0);
  EXPECT_TRUE(before.value_or("x") == read_file(out / "report.html").value_or("y"));
}

TEST(Interrupt, KeepsTheResultsSoFarAndSaysSo) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "run";
  const auto result = test::canopeer_interrupted(
      {"run", "missions/scenario_1.yaml", "--out", out.string()}, out / "record");
  EXPECT_EQ(result.status, 130);
  EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
  const auto summary = read_file(out / "summary.json");
  ASSERT_TRUE(summary.has_value());
  EXPECT_NE(summary->find("\"interrupted\": true"), std::string::npos);
  EXPECT_TRUE(fs::exists(out / "report.html"));
}

TEST(SceneRender, WritesPicturesAndGroundTruth) {
  const test::TemporaryDirectory directory;
  const auto out = directory / "scene";
  const auto result =
      test::canopeer({"scene", "render", "missions/smoke.yaml", "--out", out.string()});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* file : {"row.png", "segment_1_color.png", "segment_1_depth.png",
                           "segment_1_labels.png", "ground_truth.csv"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
}

}  // namespace
}  // namespace canopeer
