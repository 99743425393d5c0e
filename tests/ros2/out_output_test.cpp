#include <gtest/gtest.h>

#include "canopeer/ros2/out/ros2_output.h"
#include "heard.h"
#include "support/planning_fixture.h"

namespace canopeer::ros {
namespace {

using rcl_interfaces::ParameterType;
using testing_support::eventually;
using testing_support::make_node;

class Ros2OutputTest : public ::testing::Test {
 protected:
  Ros2OutputTest() {
    file_.robot = CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml";
    file_.settings_json =
        R"({"planner": "vmp", "seed": 3, "ros2.arm.speed_scale": 0.5, "ros2.confirm": false,
            "stops_travel_m": [1, 2.5], "odd": [1, "a"], "dry": true})";
  }
  std::unique_ptr<Ros2Output> output() {
    return must(Ros2Output::make({node_, std::make_shared<RosClock>(), file_, settings_,
                                  test::test_robot(), [] { return std::nullopt; }}));
  }
  rcl_interfaces::ParameterValue get(const std::string& name) {
    auto client =
        must(Client<rcl_interfaces::GetParameters>::make(*person_, "/canopeer/get_parameters"));
    EXPECT_TRUE(eventually([&] { return client.ready(); }));
    return must(client.call({{name}}, std::chrono::seconds(20))).values.at(0);
  }
  rcl_interfaces::SetParametersResult set(const std::string& name, const ParameterValue& value) {
    auto client =
        must(Client<rcl_interfaces::SetParameters>::make(*person_, "/canopeer/set_parameters"));
    EXPECT_TRUE(eventually([&] { return client.ready(); }));
    return must(client.call({{{name, value}}}, std::chrono::seconds(20))).results.at(0);
  }

  MissionFile file_;
  Ros2Settings settings_;
  std::shared_ptr<Node> node_ = make_node("canopeer");
  std::unique_ptr<Node> person_ = make_node("person");
};

TEST_F(Ros2OutputTest, HasEverySettingAsAParameter) {
  const auto told = output();
  EXPECT_EQ(get("mission.planner").string_value, "vmp");
  EXPECT_EQ(get("mission.seed").integer_value, 3);
  EXPECT_DOUBLE_EQ(get("arm.speed_scale").double_value, 0.5);
  EXPECT_EQ(get("mission.stops_travel_m").double_array_value, (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(get("mission.odd").string_value, "[1,\"a\"]");
  EXPECT_TRUE(get("mission.dry").bool_value);
  EXPECT_EQ(get("use_sim_time").type, ParameterType::PARAMETER_BOOL);
  EXPECT_EQ(get("nothing").type, ParameterType::PARAMETER_NOT_SET);
}

TEST_F(Ros2OutputTest, SetsWhatMakesSenseAndRefusesTheRest) {
  const auto told = output();
  EXPECT_TRUE(set("output.map_rate_hz", parameter_value(5.0)).successful);
  EXPECT_DOUBLE_EQ(get("output.map_rate_hz").double_value, 5.0);
  EXPECT_FALSE(set("output.map_rate_hz", parameter_value(500.0)).successful);
  EXPECT_TRUE(told->may_move("move", [] { return true; }));
  EXPECT_TRUE(set("confirm", parameter_value(true)).successful);
  EXPECT_FALSE(told->may_move("move", [] { return true; }));
  const auto refused = set("arm.speed_scale", parameter_value(1.0));
  EXPECT_FALSE(refused.successful);
  EXPECT_NE(refused.reason.find("arm.speed_scale"), std::string::npos);
}

TEST_F(Ros2OutputTest, StopsByService) {
  const auto told = output();
  auto client = must(Client<std_srvs::Trigger>::make(*person_, "/canopeer/stop"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  EXPECT_TRUE(must(client.call({}, std::chrono::seconds(20))).success);
  EXPECT_TRUE(told->stop_asked());
  EXPECT_EQ(told->steering().ask({}).kind, SteeringWord::Kind::stop);
}

TEST_F(Ros2OutputTest, SpeaksOnRosoutOnlyWhereNothingElseIsToBeTold) {
  settings_.output.enabled = false;
  const auto told = output();
  const Heard<rcl_interfaces::Log> log(*person_, "/rosout", Qos{true, true, 100});
  told->watcher()->on_event(RunBegun{0.0, 1, 60.0, false, {}});
  EXPECT_TRUE(log.comes());
  EXPECT_TRUE(person_->publishers_of("/canopeer/progress").empty());
  EXPECT_TRUE(person_->publishers_of("/tf").empty());
}

}  // namespace
}  // namespace canopeer::ros
