#include "canopeer/campaign/suite.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/suite_results.h"
#include "canopeer/scene/scene_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

Suite shipped() {
  auto suite = load_suite(fs::path(CANOPEER_SOURCE_DIR) / "benchmark");
  EXPECT_TRUE(suite.has_value()) << suite.error().message;
  return suite.value_or(Suite{});
}

TEST(Suite, HasTwentyFourWorldsOfEveryKindAndEachIsWhatItWasFrozenAs) {
  const Suite suite = shipped();
  ASSERT_EQ(suite.worlds.size(), 24U);
  const auto verified = verify_suite(suite);
  EXPECT_TRUE(verified.has_value()) << verified.error().message;
  std::map<std::string, int> counts;
  std::set<std::uint64_t> seeds;
  for (const SuiteWorld& world : suite.worlds) {
    for (const std::string& what : {world.split, world.kind, world.noise,
                                    world.kind + std::to_string(world.levels) + world.noise}) {
      ++counts[what];
    }
    seeds.insert(world.seed);
    EXPECT_EQ(world.sha256.size(), 64U) << world.name;
    EXPECT_GE(world.fruits_counted, 10) << world.name;
  }
  EXPECT_EQ(seeds.size(), 24U);
  EXPECT_EQ(counts["train"], 8);
  EXPECT_EQ(counts["validation"], 4);
  EXPECT_EQ(counts["test"], 12);
  EXPECT_EQ(counts["imported"], 4);
  for (const char* kind : {"sparse", "dense"}) {
    for (const char* levels : {"1", "2"}) {
      for (const char* noise : {"clean", "d435", "noisy"}) {
        EXPECT_GE(counts[std::string(kind) + levels + noise], 1) << kind << levels << noise;
      }
    }
  }
  EXPECT_EQ(worlds_of(suite, "test")->size(), 12U);
  EXPECT_EQ(worlds_of(suite, "all")->size(), 24U);
  EXPECT_FALSE(worlds_of(suite, "tests").has_value());
}

TEST(Suite, ScenesHoldTheFruitsThatTheListSays) {
  for (const SuiteWorld& world : shipped().worlds) {
    const auto scene =
        read_scene_file(world.mission.parent_path() / (world.name + std::string(kSceneFileEnding)));
    ASSERT_TRUE(scene.has_value()) << scene.error().message;
    EXPECT_EQ(scene->counted_fruits(), world.fruits_counted) << world.name;
    EXPECT_EQ(scene->seed, world.seed) << world.name;
    EXPECT_EQ(scene->imported, world.kind == "imported") << world.name;
  }
}

TEST(Suite, AChangedFileIsAnErrorThatNamesIt) {
  const fs::path folder = fs::temp_directory_path() / "canopeer_changed_suite";
  fs::remove_all(folder);
  fs::copy(fs::path(CANOPEER_SOURCE_DIR) / "benchmark", folder, fs::copy_options::recursive);
  Suite suite = *load_suite(folder);
  ASSERT_TRUE(verify_suite(suite).has_value());
  const fs::path mission = suite.worlds.front().mission;
  ASSERT_TRUE(write_file(mission, *read_file(mission) + "# changed\n").has_value());
  const auto changed = verify_suite(suite);
  ASSERT_FALSE(changed.has_value());
  EXPECT_NE(changed.error().message.find(mission.filename().string()), std::string::npos);
  fs::remove(mission);
  EXPECT_FALSE(verify_suite(suite).has_value());
  fs::remove_all(folder);
}

SuiteRun run(const std::string& world, const std::string& planner, std::uint64_t seed, double auc,
             int fruits) {
  SuiteRun run;
  run.world = world;
  run.protocol = "tight10";
  run.planner = planner;
  run.seed = seed;
  run.fruits_total = fruits;
  run.auc = auc;
  return run;
}

TEST(SuiteScore, WorldsCountAlikeAndAreDividedByTheBestKnown) {
  const std::vector<SuiteRun> runs = {run("a", "vmp", 1, 0.4, 20), run("a", "vmp", 2, 0.6, 20),
                                      run("b", "vmp", 1, 0.2, 30)};
  const auto by_best =
      suite_scores(runs, {{"a", "tight10", 0.5, "x"}, {"b", "tight10", 0.8, "clairvoyant"}});
  ASSERT_EQ(by_best.size(), 1U);
  EXPECT_TRUE(by_best[0].normalised);
  EXPECT_NEAR(by_best[0].value.mean, 0.5 * (0.5 / 0.5 + 0.2 / 0.8), 1e-12);
  EXPECT_LE(by_best[0].value.low95, by_best[0].value.mean);
  EXPECT_EQ(by_best[0].worlds, 2);
  EXPECT_EQ(by_best[0].runs, 3);
  // One world without: the number is AUC itself.
  const auto plain = suite_scores(runs, {{"a", "tight10", 0.5, "x"}});
  EXPECT_FALSE(plain[0].normalised);
  EXPECT_NEAR(plain[0].value.mean, 0.5 * (0.5 + 0.2), 1e-12);
}

SuiteResults entry(const Suite& suite) {
  SuiteResults results;
  results.canopeer_version = "1";
  results.suite_version = suite.version;
  results.suite_sha256 = suite.sha256;
  results.split = "validation";
  for (const SuiteWorld& world : suite.worlds) {
    if (world.split != "validation") continue;
    for (const std::uint64_t seed : {1, 2}) {
      results.runs.push_back(run(world.name, "vmp", seed, 0.5, world.fruits_counted));
    }
  }
  results.scores = suite_scores(results.runs, {});
  return results;
}

TEST(SuiteResults, ComeBackFromTheirFileAndAreValid) {
  const Suite suite = shipped();
  const SuiteResults results = entry(suite);
  const std::string json = suite_results_json(results);
  const auto again = parse_suite_results(json);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(suite_results_json(*again), json);
  EXPECT_EQ(faults_of(*again, suite), std::vector<std::string>{});
  for (const char* text : {"", "{}", "[1]", R"({"format":"canopeer-bench-suite"})"}) {
    EXPECT_FALSE(parse_suite_results(text).has_value()) << text;
  }
}

TEST(SuiteResults, EveryFaultIsNamed) {
  const Suite suite = shipped();
  const auto faulty = [&](auto change) {
    SuiteResults results = entry(suite);
    change(results);
    return faults_of(results, suite).size();
  };
  EXPECT_EQ(faulty([](SuiteResults&) {}), 0U);
  EXPECT_EQ(faulty([](SuiteResults& r) { r.suite_sha256 = "0"; }), 1U);
  EXPECT_EQ(faulty([](SuiteResults& r) { r.settings = {"graph.neighbors=8"}; }), 1U);
  EXPECT_EQ(faulty([](SuiteResults& r) { r.scores[0].value.mean = 0.9; }), 1U);
  EXPECT_GE(faulty([](SuiteResults& r) { r.runs.pop_back(); }), 1U);
  EXPECT_GE(faulty([](SuiteResults& r) { r.runs[0].auc = 1.5; }), 1U);
  EXPECT_GE(faulty([](SuiteResults& r) { r.runs[0].fruits_total += 1; }), 1U);
  EXPECT_GE(faulty([](SuiteResults& r) { r.runs[0].world = "nowhere"; }), 1U);
  EXPECT_GE(faulty([](SuiteResults& r) { r.runs[0].planner = "vmp@free"; }), 1U);
  EXPECT_GE(faulty([](SuiteResults& r) { r.split = "test"; }), 1U);
}

}  // namespace
}  // namespace canopeer
