#include "canopeer/planner/playback/plan_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

Configuration configuration(std::initializer_list<double> values) {
  Configuration q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

std::string error_of(const std::string& text) {
  const auto plan = parse_view_plan(text, "plan.json");
  return plan ? "no error" : plan.error().message;
}

TEST(PlanFile, AnyPlanReadsBackAsItWasAndGivesTheSameBytes) {
  Rng rng(1, "plans");
  for (int trial = 0; trial < 200; ++trial) {
    ViewPlan plan;
    plan.segments.resize(rng.index(4));
    for (auto& views : plan.segments) {
      for (std::size_t v = rng.index(5); v > 0; --v) {
        views.push_back(configuration({rng.normal(), 1e-300 * rng.normal(), 1e9 * rng.normal(),
                                       std::round(rng.uniform(-3, 3)), 0.1, -0.0}));
      }
    }
    const std::string text = view_plan_json(plan).value();
    const auto read = parse_view_plan(text, "plan.json");
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->segments, plan.segments);
    EXPECT_EQ(view_plan_json(*read).value(), text);
  }
}

TEST(PlanFile, OnDiskErrorsBeginWithTheFile) {
  const auto path = std::filesystem::temp_directory_path() / "canopeer_plan_file_test.json";
  ViewPlan plan;
  plan.segments = {{configuration({0.5, 1.0})}, {}};
  ASSERT_TRUE(write_view_plan(path, plan).has_value());
  EXPECT_EQ(read_view_plan(path).value().segments, plan.segments);
  ASSERT_TRUE(write_file(path, "{").has_value());
  EXPECT_EQ(read_view_plan(path).error().message.find(path.string()), 0U);
  std::filesystem::remove(path);
  EXPECT_NE(read_view_plan(path).error().message.find(path.string()), std::string::npos);
  plan.segments[0][0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(write_view_plan(path, plan).error().message.find("segment 1, view 1, joint 2"),
            std::string::npos);
}

TEST(PlanFile, ErrorsSayWhere) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"", "plan.json: line 1, column 1"},
      {"{\n \"canopeer_plan\": 1,,\n}", "plan.json: line 2, column 21"},
      {"[]", "\"canopeer_plan\""},
      {"{\"segments\": []}", "\"canopeer_plan\""},
      {"{\"canopeer_plan\": 2, \"segments\": []}", "expected 1"},
      {"{\"canopeer_plan\": 1}", "\"segments\": expected a list"},
      {"{\"canopeer_plan\": 1, \"segments\": {}}", "\"segments\": expected a list"},
      {"{\"canopeer_plan\": 1, \"segments\": [], \"segment\": []}", "unknown key \"segment\""},
      {"{\"canopeer_plan\": 1, \"segments\": [[], 3]}", "segment 2: expected a list of views"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[1], 3]]}", "segment 1, view 2: expected a list"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[]]]}", "segment 1, view 1: expected a list"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[1, null]]]}", "segment 1, view 1, joint 2"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[1, \"2\"]]]}", "segment 1, view 1, joint 2"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[1, 1e999]]]}", "too large"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[1, 2]], [[1]]]}", "segment 2, view 1: 1 joint"},
      {"{\"canopeer_plan\": 1, \"segments\": [[[1,2,3,4,5,6,7,8,9,10,11]]]}", "at most 10"},
  };
  for (const auto& [text, part] : wrong) {
    const std::string error = error_of(text);
    EXPECT_EQ(error.find("plan.json: "), 0U) << error;
    EXPECT_NE(error.find(part), std::string::npos) << text << "\n" << error;
  }
}

TEST(PlanFile, AnyCutOfAFileIsAnErrorAndNoCrash) {
  ViewPlan plan;
  plan.segments = {{configuration({0.5, 1.0}), configuration({-1e-5, 2.0})}, {}};
  const std::string text = view_plan_json(plan).value();
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_FALSE(parse_view_plan(text.substr(0, length), "plan.json").has_value()) << length;
  }
}

TEST(PlanFile, IsHeldAgainstMissionAndRobot) {
  PlanFit fit;
  fit.segments = 2;
  fit.limits.lower = configuration({-1.0, -std::numeric_limits<double>::infinity()});
  fit.limits.upper = configuration({1.0, std::numeric_limits<double>::infinity()});
  ViewPlan plan;
  plan.segments = {{configuration({1.0, 99.0})}, {configuration({-1.0, 0.0})}};
  EXPECT_TRUE(check_plan(plan, fit).has_value());
  plan.segments[1][0][0] = -1.1;
  EXPECT_NE(check_plan(plan, fit).error().message.find("segment 2, view 1, joint 1: -1.1"),
            std::string::npos);
  plan.segments[1][0] = configuration({0.0});
  EXPECT_NE(check_plan(plan, fit).error().message.find("segment 2, view 1: 1 joint positions"),
            std::string::npos);
  plan.segments.pop_back();
  EXPECT_NE(check_plan(plan, fit).error().message.find("1 segments, and the mission has 2"),
            std::string::npos);
}

}  // namespace
}  // namespace canopeer
