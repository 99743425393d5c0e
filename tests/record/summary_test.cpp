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
