#include "canopeer/campaign/campaign_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

CampaignPlan small_plan() {
  CampaignPlan plan;
  plan.missions = {"missions/a.yaml", "missions/b.yaml"};
  plan.contestants = {{"vmp", ""}, {"rvp", "reference"}};
  plan.budgets_s = {10, 20};
  plan.runs = 3;
  return plan;
}

TEST(CampaignPlan, ContestantsAreAPlannerAndMaybeATable) {
  EXPECT_EQ(parse_contestant("vmp")->planner, "vmp");
  EXPECT_EQ(parse_contestant("vmp")->table, "");
  EXPECT_EQ(parse_contestant("rvp@reference")->planner, "rvp");
  EXPECT_EQ(parse_contestant("rvp@reference")->table, "reference");
  EXPECT_EQ(parse_contestant("rvp@reference")->label(), "rvp@reference");
  for (const char* bad : {"", "@x", "vmp@"}) EXPECT_FALSE(parse_contestant(bad).has_value()) << bad;
}

TEST(CampaignPlan, MakesEveryCombinationOnceInAFolderOfItsOwnSeedBySeed) {
  const auto jobs = all_jobs(small_plan());
  EXPECT_EQ(jobs.size(), 2U * 2U * 2U * 3U);
  std::set<std::string> dirs;
  for (const auto& job : jobs) dirs.insert(job.dir.string());
  EXPECT_EQ(dirs.size(), jobs.size());
  EXPECT_TRUE(std::is_sorted(jobs.begin(), jobs.end(),
                             [](const auto& a, const auto& b) { return a.seed < b.seed; }));
  EXPECT_EQ(jobs.front().dir, "runs/a/10s/vmp/seed_1");
}

TEST(CampaignPlan, ShardsShareTheRunsAmongThemselves) {
  CampaignPlan plan = small_plan();
  plan.shards = 5;
  std::multiset<std::string> dirs;
  for (plan.shard = 1; plan.shard <= 5; ++plan.shard) {
    ASSERT_TRUE(validate(plan).has_value());
    for (const auto& job : shard_jobs(plan)) dirs.insert(job.dir.string());
  }
  const auto jobs = all_jobs(plan);
  EXPECT_EQ(dirs.size(), jobs.size());
  for (const auto& job : jobs) EXPECT_EQ(dirs.count(job.dir.string()), 1U);
}

TEST(CampaignPlan, WhatMakesNoSenseIsRefused) {
  ASSERT_TRUE(validate(small_plan()).has_value());
  const auto refused = [](auto change) {
    CampaignPlan plan = small_plan();
    change(plan);
    return !validate(plan).has_value();
  };
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.missions.clear(); }));
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.contestants.clear(); }));
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.missions.push_back("other/a.yaml"); }));
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.contestants.push_back({"vmp", ""}); }));
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.budgets_s.push_back(10); }));
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.runs = 0; }));
  EXPECT_TRUE(refused([](CampaignPlan& p) { p.shard = 2; }));
}

TEST(CampaignPlan, ProtocolsTakeThePlaceOfBudgets) {
  CampaignPlan plan = small_plan();
  plan.protocols = {"tight10", "views10"};
  EXPECT_NE(validate(plan).error().message.find("either them or budgets"), std::string::npos);
  plan.budgets_s.clear();
  ASSERT_TRUE(validate(plan).has_value());
  const auto jobs = all_jobs(plan);
  EXPECT_EQ(jobs.size(), 2U * 2U * 2U * 3U);
  EXPECT_EQ(jobs.front().dir, "runs/a/tight10/vmp/seed_1");
  EXPECT_EQ(jobs[2].dir, "runs/a/views10/vmp/seed_1");
  const auto words = run_arguments(plan, jobs[2], "here");
  const auto at = std::find(words.begin(), words.end(), "--protocol");
  ASSERT_NE(at, words.end());
  EXPECT_EQ(*(at + 1), "views10");
  plan.protocols.emplace_back("tight10");
  EXPECT_FALSE(validate(plan).has_value());
}

TEST(CampaignPlan, YardsticksAreOfASeedOrOfAFrozenWorld) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "campaign_yardsticks";
  fs::remove_all(folder);
  CampaignPlan plan = small_plan();
  plan.budgets_s.clear();
  plan.protocols = {"tight10"};
  plan.yardsticks = folder;
  const CampaignJob job = all_jobs(plan).front();
  EXPECT_TRUE(yardstick_of(plan, job).empty());
  const auto put = [&](const fs::path& path) {
    fs::create_directories(path.parent_path());
    ASSERT_TRUE(write_file(path, "{}"));
  };
  put(folder / "a/tight10.json");
  EXPECT_EQ(yardstick_of(plan, job), folder / "a/tight10.json");
  put(folder / "a/seed_1/tight10.json");
  EXPECT_EQ(yardstick_of(plan, job), folder / "a/seed_1/tight10.json");
  put(folder / "a/own.json");
  plan.protocols.clear();
  EXPECT_EQ(yardstick_of(plan, all_jobs(plan).front()), folder / "a/own.json");
  plan.budgets_s = {10};
  EXPECT_TRUE(yardstick_of(plan, all_jobs(plan).front()).empty());
}

TEST(CampaignPlan, ARunIsTheCommandAUserWouldType) {
  CampaignPlan plan = small_plan();
  plan.settings = {"graph.neighbors=6"};
  plan.segments = 2;
  const auto jobs = all_jobs(plan);
  const auto words = run_arguments(plan, jobs[1], "here");
  const std::vector<std::string> expected = {"run",
                                             "missions/a.yaml",
                                             "--no-replay",
                                             "--planner",
                                             "rvp",
                                             "--seed",
                                             "1",
                                             "--threads",
                                             "1",
                                             "--quiet",
                                             "--out",
                                             "here",
                                             "--compute-table",
                                             "reference",
                                             "--time-per-segment",
                                             "10",
                                             "--segments",
                                             "2",
                                             "--set",
                                             "graph.neighbors=6"};
  EXPECT_EQ(words, expected);
}

}  // namespace
}  // namespace canopeer
