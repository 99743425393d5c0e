#include "canopeer/campaign/job_pool.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// A program in place of `canopeer`: a shell script that is told what to do with its --out folder.
class JobPoolTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() /
            ("canopeer_jobs_" +
             std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(root_);
    plan_.missions = {root_ / "m.yaml"};
    plan_.contestants = {{"vmp", ""}, {"rvp", ""}};
    plan_.runs = 2;
    ASSERT_TRUE(write_file(root_ / "m.yaml", "name: m\n").has_value());
    options_.out = root_ / "out";
    options_.processes = 2;
    program("echo made > \"$out/summary.json\"");
  }
  void TearDown() override { fs::remove_all(root_); }

  /// `body` sees $out, $planner and $seed.
  void program(const std::string& body) {
    options_.program = root_ / "program.sh";
    std::ofstream(options_.program) << "#!/bin/sh\n"
                                       "while [ $# -gt 0 ]; do case $1 in --out) out=$2;; "
                                       "--planner) planner=$2;; --seed) seed=$2;; esac; shift; "
                                       "done\necho run >> " +
                                           (root_ / "starts").string() + "\n" + body + "\n";
    fs::permissions(options_.program, fs::perms::owner_all);
  }
  [[nodiscard]] int starts() const {
    std::ifstream file(root_ / "starts");
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines;
  }
  Expected<void> run() {
    return run_jobs(plan_, options_, stop_, [this](const CampaignProgress& p) {
      last_ = p;
      if (p.changed != nullptr && p.state == JobState::failed) message_ = p.message;
      if (p.done == stop_at_) stop_ = true;
    });
  }

  fs::path root_;
  CampaignPlan plan_;
  JobPoolOptions options_;
  std::atomic<bool> stop_{false};
  int stop_at_ = -1;
  CampaignProgress last_;
  std::string message_;
};

TEST_F(JobPoolTest, MakesEveryRunOnceAndNoneASecondTime) {
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(last_.done, 4);
  EXPECT_EQ(last_.failed, 0);
  for (const auto& job : all_jobs(plan_)) {
    EXPECT_TRUE(is_done(options_.out, job));
    EXPECT_TRUE(fs::exists(options_.out / job.dir / "summary.json"));
  }
  EXPECT_EQ(starts(), 4);
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(starts(), 4);
  EXPECT_EQ(last_.done, 4);
}

TEST_F(JobPoolTest, GoesOnWhereItWasStopped) {
  options_.processes = 1;
  stop_at_ = 2;
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(last_.done, 2);
  stop_ = false;
  stop_at_ = -1;
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(last_.done, 4);
  EXPECT_LE(starts(), 5);  // at most the one that was under way is made twice
}

TEST_F(JobPoolTest, ARunCutShortLeavesNothingThatCountsAsDone) {
  const auto job = all_jobs(plan_).front();
  const fs::path part = options_.out / (job.dir.string() + ".part");
  fs::create_directories(part);
  ASSERT_TRUE(write_file(part / "summary.json", "half").has_value());
  EXPECT_FALSE(is_done(options_.out, job));
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(read_file(options_.out / job.dir / "summary.json").value(), "made\n");
  EXPECT_FALSE(fs::exists(part));
}

/// Two pools at once, each with a progress of its own: two processes in the same folder.
void run_both(const CampaignPlan& one, const CampaignPlan& other, const JobPoolOptions& options,
              CampaignProgress& of_one, CampaignProgress& of_other) {
  const std::atomic<bool> stop{false};
  const auto make = [&](const CampaignPlan& plan, CampaignProgress& last) {
    const auto ok = run_jobs(plan, options, stop, [&](const CampaignProgress& p) { last = p; });
    EXPECT_TRUE(ok.has_value()) << ok.error().message;
  };
  std::thread second([&] { make(other, of_other); });
  make(one, of_one);
  second.join();
}

TEST_F(JobPoolTest, ShardsInOneFolderShareNothing) {
  plan_.runs = 6;
  program("echo $planner$seed > \"$out/summary.json\"");
  CampaignPlan other = plan_;
  plan_.shards = other.shards = 2;
  other.shard = 2;
  CampaignProgress one;
  CampaignProgress two;
  run_both(plan_, other, options_, one, two);
  EXPECT_EQ(one.done + two.done, 12);
  EXPECT_EQ(starts(), 12);
  for (const auto& job : all_jobs(plan_)) {
    EXPECT_EQ(read_file(options_.out / job.dir / "summary.json").value(),
              job.contestant.planner + std::to_string(job.seed) + "\n");
  }
}

TEST_F(JobPoolTest, OfTwoThatMakeTheSameRunTheFirstCountsAndNeitherFails) {
  // Both begin every run before either ends it: each writes, waits for the other, writes again.
  program(
      "echo begun > \"$out/summary.json\"; touch \"$out/../here.$$\"; i=0; while [ $i -lt 200 ] && "
      "[ $(ls -d \"$out\"/../here.* | wc -l) -lt 2 ]; do i=$((i + 1)); sleep 0.01; done; echo "
      "whole "
      "> \"$out/summary.json\"");
  options_.processes = 1;
  CampaignProgress one;
  CampaignProgress two;
  run_both(plan_, plan_, options_, one, two);
  for (const auto& progress : {one, two}) {
    EXPECT_EQ(progress.done, 4);
    EXPECT_EQ(progress.failed, 0);
  }
  EXPECT_GT(starts(), 4);
  for (const auto& job : all_jobs(plan_)) {
    const fs::path dir = options_.out / job.dir;
    EXPECT_EQ(read_file(dir / "summary.json").value(), "whole\n");
    for (const auto& entry : fs::directory_iterator(dir.parent_path())) {
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    }
  }
}

TEST_F(JobPoolTest, AnotherShardOfAnotherCommandIsNotMixedIn) {
  plan_.shards = 2;
  ASSERT_TRUE(run().has_value());
  plan_.shard = 2;
  plan_.settings = {"graph.neighbors=4"};
  EXPECT_FALSE(run().has_value());
}

TEST_F(JobPoolTest, TheMissionFileMayLieElsewhereOnAnotherMachine) {
  ASSERT_TRUE(run().has_value());
  fs::create_directories(root_ / "other");
  fs::copy_file(root_ / "m.yaml", root_ / "other/m.yaml");
  plan_.missions = {root_ / "other/m.yaml"};
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(starts(), 4);
}

TEST_F(JobPoolTest, AFailedRunIsReportedAndTheOthersGoOn) {
  program(
      "[ $planner$seed = rvp1 ] && { echo 'the arm fell off'; exit 1; }; echo made > "
      "\"$out/summary.json\"");
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(last_.done, 3);
  EXPECT_EQ(last_.failed, 1);
  EXPECT_EQ(message_, "the arm fell off");
  program("echo made > \"$out/summary.json\"");
  ASSERT_TRUE(run().has_value());  // and is tried again next time
  EXPECT_EQ(last_.done, 4);
}

TEST_F(JobPoolTest, RunsOfAnotherMissionFileAreNotMixedIn) {
  ASSERT_TRUE(run().has_value());
  ASSERT_TRUE(write_file(root_ / "m.yaml", "name: changed\n").has_value());
  const auto again = run();
  ASSERT_FALSE(again.has_value());
  EXPECT_NE(again.error().message.find("another command or another mission file"),
            std::string::npos);
}

TEST_F(JobPoolTest, AProgramThatIsNotThereIsAFailure) {
  options_.program = root_ / "nothing";
  ASSERT_TRUE(run().has_value());
  EXPECT_EQ(last_.failed, 4);
}

}  // namespace
}  // namespace canopeer
