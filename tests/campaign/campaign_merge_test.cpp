#include "canopeer/campaign/campaign_merge.h"

#include <gtest/gtest.h>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/job_pool.h"
#include "canopeer/campaign/run_command.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

class CampaignMerge : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() /
            ("canopeer_merge_" +
             std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(root_);
    ASSERT_TRUE(write_file(root_ / "m.yaml", "name: m\n").has_value());
    plan_.missions = {root_ / "m.yaml"};
    plan_.contestants = {{"vmp", ""}, {"rvp", ""}};
    plan_.runs = 2;
  }
  void TearDown() override { fs::remove_all(root_); }

  /// A run as it lies in a campaign's folder.
  void made(const CampaignPlan& plan, const fs::path& folder, const CampaignJob& job,
            const std::string& record = "record\n") const {
    const fs::path dir = folder / job.dir;
    fs::create_directories(dir / "plots");
    ASSERT_TRUE(write_file(dir / "record", record).has_value());
    ASSERT_TRUE(write_file(dir / "plots/found.svg", job.dir.string()).has_value());
    ASSERT_TRUE(write_file(dir / "command", command_text(plan, job)).has_value());
  }
  void shard_made(int shard, const fs::path& folder) const {
    CampaignPlan plan = plan_;
    plan.shard = shard;
    plan.shards = 2;
    for (const auto& job : shard_jobs(plan)) made(plan, folder, job);
  }
  [[nodiscard]] Expected<MergeOutcome> merge(const std::vector<fs::path>& parts) const {
    return merge_campaigns(plan_, parts, root_ / "out");
  }
  void expect_refused(const std::vector<fs::path>& parts, const std::string& why) const {
    const auto outcome = merge(parts);
    ASSERT_FALSE(outcome.has_value());
    EXPECT_NE(outcome.error().message.find(why), std::string::npos) << outcome.error().message;
    EXPECT_FALSE(fs::exists(root_ / "out/runs"));
  }

  fs::path root_;
  CampaignPlan plan_;
};

TEST_F(CampaignMerge, JoinsTheShardsOfTwoMachines) {
  shard_made(1, root_ / "a");
  shard_made(2, root_ / "b");
  const auto outcome = merge({root_ / "a", root_ / "b"});
  ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
  EXPECT_EQ(outcome->taken, 4);
  EXPECT_EQ(outcome->twice, 0);
  EXPECT_EQ(outcome->strangers, 0);
  for (const auto& job : all_jobs(plan_)) {
    EXPECT_TRUE(is_done(root_ / "out", job));
    EXPECT_EQ(read_file(root_ / "out" / job.dir / "plots/found.svg").value(), job.dir.string());
    EXPECT_EQ(std::distance(fs::directory_iterator((root_ / "out" / job.dir).parent_path()),
                            fs::directory_iterator()),
              2);  // seeds, and nothing that is left over
  }
  const auto again = merge({root_ / "b", root_ / "a"});
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->taken, 0);
  EXPECT_EQ(again->twice, 4);
}

TEST_F(CampaignMerge, WhatIsChangedInOneFolderStaysAsItWasInTheOther) {
  shard_made(1, root_ / "a");
  ASSERT_TRUE(merge({root_ / "a"}).has_value());
  const fs::path file = all_jobs(plan_).front().dir / "plots/found.svg";
  ASSERT_TRUE(write_file(root_ / "out" / file, "changed").has_value());
  EXPECT_NE(read_file(root_ / "a" / file).value(), "changed");
}

TEST_F(CampaignMerge, TakesNoPartOfARun) {
  shard_made(1, root_ / "a");
  const auto missing = all_jobs(plan_).at(1);
  const fs::path part = root_ / "a" / (missing.dir.string() + ".0123abcd.part");
  fs::create_directories(part);
  ASSERT_TRUE(write_file(part / "command", command_text(plan_, missing)).has_value());
  const auto outcome = merge({root_ / "a"});
  ASSERT_TRUE(outcome.has_value());
  EXPECT_EQ(outcome->taken, 2);
  EXPECT_EQ(outcome->strangers, 0);
  EXPECT_FALSE(is_done(root_ / "out", missing));
}

TEST_F(CampaignMerge, RunsOfMoreSeedsStayWhereTheyAre) {
  plan_.runs = 3;
  shard_made(1, root_ / "a");
  plan_.runs = 1;
  const auto outcome = merge({root_ / "a"});
  ASSERT_TRUE(outcome.has_value());
  EXPECT_EQ(outcome->taken, 1);
  EXPECT_EQ(outcome->strangers, 2);
}

TEST_F(CampaignMerge, NamesRunsOfAnotherCommand) {
  shard_made(1, root_ / "a");
  plan_.settings = {"graph.neighbors=4"};
  expect_refused({root_ / "a"}, "vmp/seed_1: was made by another command");
}

TEST_F(CampaignMerge, NamesRunsThatDifferThoughTheirCommandIsTheSame) {
  shard_made(1, root_ / "a");
  const auto job = all_jobs(plan_).front();
  made(plan_, root_ / "b", job, "another record\n");
  expect_refused({root_ / "a", root_ / "b"}, "b/" + job.dir.string() + ": is another run than ");
}

TEST_F(CampaignMerge, AShardMayHaveHadNothingToDo) {
  shard_made(1, root_ / "a");
  fs::create_directories(root_ / "b");
  ASSERT_TRUE(write_file(root_ / "b/comparison.csv", "").has_value());
  const auto outcome = merge({root_ / "b", root_ / "a"});
  ASSERT_TRUE(outcome.has_value());
  EXPECT_EQ(outcome->taken, 2);
}

TEST_F(CampaignMerge, RefusesFoldersThatCannotBeMeant) {
  shard_made(1, root_ / "a");
  expect_refused({root_ / "nowhere"}, "nowhere: holds no runs");
  fs::create_directories(root_ / "empty/runs");
  expect_refused({root_ / "a", root_ / "empty"}, "empty: holds no runs");
  fs::create_directories(root_ / "out");
  expect_refused({root_ / "a/../out"}, "is the folder to merge into");
}

}  // namespace
}  // namespace canopeer
