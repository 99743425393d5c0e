#include "canopeer/record/summary.h"

#include <gtest/gtest.h>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

TEST(Summary, ReadsBackWhatItWroteAndKeepsUnknownFiguresNull) {
  Summary summary;
  summary.mission = "scenario_1";
  summary.planner = "vmp";
  summary.seed = 42;
  summary.sim_time_s = 480.0 / 7.0;
  summary.detected = 0;
  summary.auc = 0.1;
  summary.interrupted = true;
  const auto path = std::filesystem::path(testing::TempDir()) / "summary_test.json";
  ASSERT_TRUE(write_summary(path, summary));
  const Expected<Summary> read = read_summary(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->mission, "scenario_1");
  EXPECT_EQ(read->seed, 42U);
  EXPECT_EQ(read->sim_time_s, 480.0 / 7.0);
  EXPECT_EQ(read->detected, 0);
  EXPECT_EQ(read->auc, 0.1);
  EXPECT_TRUE(read->interrupted);
  EXPECT_FALSE(read->roi_surface_coverage.has_value());
  EXPECT_EQ(summary_json(*read), summary_json(summary));
  EXPECT_NE(summary_json(summary).find("\"roi_surface_coverage\": null"), std::string::npos);
}

TEST(Summary, KeepsRulesTimesAndShares) {
  Summary summary;
  summary.protocol = "views10";
  summary.auc_views = 1.0 / 3.0;
  summary.time = TimeSplit{1.0, 2.5, 1.0 / 7.0, 0.0, 4.0};
  summary.certified_auc_gap = 0.25;
  const auto path = std::filesystem::path(testing::TempDir()) / "summary_rules.json";
  ASSERT_TRUE(write_summary(path, summary));
  const Expected<Summary> read = read_summary(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(summary_json(*read), summary_json(summary));
  EXPECT_EQ(read->protocol, "views10");
  EXPECT_EQ(read->time->execution_s, 1.0 / 7.0);
  EXPECT_FALSE(read->ceiling_fruits_share.has_value());
}

TEST(Summary, ComparesGainsOverTheSameSpace) {
  RunRecord record;
  for (int i = 0; i < 5; ++i) {
    ViewEvent view;
    view.predicted_gain = 10.0 * i;
    view.realised_gain = 100 - i;  // what it saw elsewhere says the opposite
    view.realised_in_fan = i * i;
    record.views.push_back(view);
  }
  record.views.emplace_back();  // nothing was predicted
  EXPECT_DOUBLE_EQ(summary_of(record).gain_correlation_same_space.value(), 1.0);
  record.views.resize(2);
  EXPECT_FALSE(summary_of(record).gain_correlation_same_space.has_value());
}

TEST(Summary, AddsUpTheCamerasPath) {
  RunRecord record;
  record.motions.resize(3);
  EXPECT_FALSE(summary_of(record).camera_path_length_m.has_value());
  record.motions[0].camera_path_m = 0.5;
  record.motions[2].camera_path_m = 1.25;
  EXPECT_DOUBLE_EQ(summary_of(record).camera_path_length_m.value(), 1.75);
}

TEST(Summary, ErrorsNameFileAndKey) {
  const auto path = std::filesystem::path(testing::TempDir()) / "summary_bad.json";
  ASSERT_TRUE(write_file(path, "{\"canopeer_version\": 3}"));
  Expected<Summary> read = read_summary(path);
  ASSERT_FALSE(read.has_value());
  EXPECT_NE(read.error().message.find("summary_bad.json: 'canopeer_version'"), std::string::npos);
  ASSERT_TRUE(write_file(path, "{\n  \"mission\": \n}"));
  read = read_summary(path);
  ASSERT_FALSE(read.has_value());
  EXPECT_NE(read.error().message.find("line 3"), std::string::npos) << read.error().message;
}

}  // namespace
}  // namespace canopeer
