#include "canopeer/bounds/clairvoyant.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/run/run.h"
#include "small_pool.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

using MissionRun = canopeer::Run;  // a test has a Run, too

/// A mission in the generated glasshouse, and a small pool of views of it.
class ClairvoyantTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() /
                 ("canopeer_clairvoyant_" +
                  std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(directory_);
    fs::create_directories(directory_);
    request_.mission = CANOPEER_SOURCE_DIR "/missions/smoke.yaml";
    request_.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  }
  void TearDown() override { fs::remove_all(directory_); }

  void set_up_stage(Overrides overrides, int views = 150) {
    request_.overrides = std::move(overrides);
    auto stage = Stage::make(request_, registries_);
    ASSERT_TRUE(stage.has_value()) << stage.error().message;
    stage_ = std::move(*stage);
    const Scene& scene = *stage_->site().truth();
    judge_ = std::make_unique<MotionJudge>(stage_->robot().model, scene);
    pool_ = test::small_pool(stage_->robot().model, stage_->robot().ik, scene, *judge_,
                             stage_->file().mission, stage_->file().simulation.camera, views);
  }

  [[nodiscard]] Expected<ClairvoyantPlan> plan(ClairvoyantOptions options = {}) const {
    options.latency_s = stage_->file().simulation.sensor.motion.latency_s;
    return plan_clairvoyant(pool_, stage_->robot().model, *judge_, stage_->file().mission,
                            FindRule{3.0}, options);
  }

  /// Follows it in the simulator.
  std::unique_ptr<MissionRun> execute(const ClairvoyantPlan& plan, Summary& summary) {
    const fs::path file = directory_ / "plan.json";
    EXPECT_TRUE(write_view_plan(file, plan.plan).has_value());
    StageRequest request = request_;
    request.overrides.emplace_back("planner", "playback");
    request.overrides.emplace_back("playback.plan", file.string());
    auto run = MissionRun::compose(request, registries_, directory_ / "run");
    EXPECT_TRUE(run.has_value()) << run.error().message;
    auto done = (*run)->execute();
    EXPECT_TRUE(done.has_value()) << done.error().message;
    EXPECT_TRUE((*run)->outcome().has_value());
    summary = *done;
    return std::move(*run);
  }

  /// Every view of the plan was taken, about when it was said to be.
  void expect_followed(const ClairvoyantPlan& plan, const RunRecord& record) {
    std::vector<double> predicted;
    std::vector<Configuration> views;
    for (std::size_t s = 0; s < plan.times_s.size(); ++s) {
      predicted.insert(predicted.end(), plan.times_s[s].begin(), plan.times_s[s].end());
      for (std::size_t v = 0; v < plan.times_s[s].size(); ++v) {
        views.push_back(v == 0 ? pool_.segments[s][0].q : plan.plan.segments[s][v - 1]);
      }
    }
    ASSERT_EQ(record.views.size(), predicted.size());
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      EXPECT_NEAR(record.views[i].t_s, predicted[i], 0.02 + 0.03 * predicted[i]) << "view " << i;
      const Configuration q = Eigen::Map<const Configuration>(
          record.views[i].q.data(), static_cast<Eigen::Index>(record.views[i].q.size()));
      EXPECT_LT(joint_distance(q, views[i]), 1e-9) << "view " << i;
    }
  }

  StageRequest request_;
  RunRegistries registries_ = RunRegistries::built_in();
  std::unique_ptr<Stage> stage_;
  std::unique_ptr<MotionJudge> judge_;
  ViewPool pool_;
  fs::path directory_;
};

TEST_F(ClairvoyantTest, ItsPlanIsFollowedWithoutAContactAndTakesAsLongAsItSays) {
  set_up_stage({{"time_per_segment_s", "8"}});
  const auto made = plan();
  ASSERT_TRUE(made.has_value()) << made.error().message;
  EXPECT_GT(made->fruits, 10);
  Summary summary;
  const auto run = execute(*made, summary);
  expect_followed(*made, run->record());
  EXPECT_EQ(summary.plant_contacts, 0);
  EXPECT_GT(summary.detected, made->fruits / 2);
  EXPECT_NEAR(summary.sim_time_s, made->end_s, 0.05 * made->end_s);
}

TEST_F(ClairvoyantTest, OfTwoSegmentsOnTheClockThatNeverStops) {
  set_up_stage({{"time_per_segment_s", "4"}, {"sides", "[1, 2]"}, {"clock", "whole"}}, 80);
  const auto made = plan();
  ASSERT_TRUE(made.has_value()) << made.error().message;
  Summary summary;
  const auto run = execute(*made, summary);
  expect_followed(*made, run->record());
  EXPECT_GT(made->plan.segments[1].size(), 0U);
}

TEST_F(ClairvoyantTest, GivesTheSamePlanAgainAndAnotherForAnotherWish) {
  // By the paper's clock the way home would count, too.
  set_up_stage({{"time_per_segment_s", "5"}, {"clock", "whole"}}, 80);
  const auto once = plan();
  const auto again = plan();
  EXPECT_EQ(view_plan_json(once->plan).value(), view_plan_json(again->plan).value());
  ClairvoyantOptions options;
  options.objective = ClairvoyantOptions::Objective::found;
  const auto found = plan(options);
  EXPECT_GE(found->fruits, once->fruits);
  EXPECT_GE(once->auc, found->auc - 1e-3);
}

TEST_F(ClairvoyantTest, WhatOthersAskedBeforeChangesNoPlan) {
  set_up_stage({{"time_per_segment_s", "5"}, {"clock", "whole"}}, 80);
  MotionVerdicts verdicts;
  ClairvoyantOptions options;
  const auto with = [&] {
    return plan_clairvoyant(pool_, stage_->robot().model, *judge_, stage_->file().mission,
                            FindRule{3.0}, options, &verdicts);
  };
  options.objective = ClairvoyantOptions::Objective::found;
  const auto found = with();
  ASSERT_GT(found->motions_blocked, 0);
  options.objective = ClairvoyantOptions::Objective::auc;
  const auto auc = with();
  const auto alone = plan_clairvoyant(pool_, stage_->robot().model, *judge_, stage_->file().mission,
                                      FindRule{3.0}, options);
  EXPECT_EQ(view_plan_json(auc->plan).value(), view_plan_json(alone->plan).value());
  EXPECT_EQ(auc->motions_judged, alone->motions_judged);
}

TEST_F(ClairvoyantTest, KeepsToTheNumberOfViewsWhereTimeIsNoLimit) {
  set_up_stage({{"time_per_segment_s", "5"}}, 80);
  MissionOptions mission = stage_->file().mission;
  mission.segment_time_s = 0.0;
  mission.max_views = 4;
  const auto made =
      plan_clairvoyant(pool_, stage_->robot().model, *judge_, mission, FindRule{3.0}, {});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  EXPECT_EQ(made->plan.segments[0].size(), 3U);
  EXPECT_TRUE(std::isfinite(made->end_s));
}

TEST_F(ClairvoyantTest, SaysWhatDoesNotFit) {
  set_up_stage({{"time_per_segment_s", "5"}}, 5);
  const auto error = [&] { return plan().error().message; };
  ViewPool whole = pool_;
  pool_.segments.emplace_back();
  EXPECT_NE(error().find("2 segments, and the mission has 1"), std::string::npos);
  pool_ = whole;
  pool_.segments[0].clear();
  EXPECT_NE(error().find("segment 1 of the pool of views: it lacks the view at home"),
            std::string::npos);
  pool_ = whole;
  pool_.segments[0][0].patches = {1000000};
  EXPECT_NE(error().find("shows patch 1000000"), std::string::npos);
  pool_ = whole;
  pool_.segments[0][0].q = Configuration::Zero(3);
  EXPECT_NE(error().find("3 joint positions"), std::string::npos);
}

TEST(ShorterPlan, LosesViewsInTheSegmentOrBeforeIt) {
  const Configuration q = Configuration::Zero(6);
  ViewPlan plan{{{q, q, q}, {q}, {}, {q, q}}};
  EXPECT_EQ(shorten(plan, 2), 1U);
  EXPECT_TRUE(plan.segments[1].empty());
  EXPECT_EQ(shorten(plan, 2), 0U);
  EXPECT_EQ(plan.segments[0].size(), 1U);
  EXPECT_EQ(shorten(plan, 9), 3U);
  EXPECT_EQ(plan.segments[3].size(), 1U);
  EXPECT_EQ(shorten(plan, 1), 0U);
  EXPECT_EQ(shorten(plan, 1), std::nullopt);
}

}  // namespace
}  // namespace canopeer
