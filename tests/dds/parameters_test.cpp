#include "canopeer/dds/parameters.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <mutex>

#include "canopeer/dds/goal_ledger.h"
#include "canopeer/dds/parameter_table.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using namespace std::chrono_literals;
using rcl_interfaces::ListParameters;
using rcl_interfaces::ParameterType;
using testing_support::eventually;
using testing_support::make_node;

/// A name that cannot be changed, a speed of 0.1 … 1, and a switch that sticks when it is on.
class Settings {
 public:
  [[nodiscard]] std::vector<ParameterAccess> accesses() {
    return {{"robot.name", "who it is", [] { return parameter_value(std::string("picker")); }, {}},
            {"arm.speed_scale", "of the limits", [this] { return parameter_value(speed_.load()); },
             [this](const ParameterValue& value) -> Expected<void> {
               speed_ = value.double_value;
               return {};
             },
             0.1, 1.0},
            {"arm.dry_run", "never moves", [this] { return parameter_value(dry_run_.load()); },
             [this](const ParameterValue& value) -> Expected<void> {
               if (dry_run_) return fail("it sticks");
               dry_run_ = value.bool_value;
               return {};
             }}};
  }
  std::atomic<double> speed_{0.5};
  std::atomic<bool> dry_run_{false};
};

TEST(ParameterTable, ListsAsRosDoes) {
  Settings settings;
  const ParameterTable table(settings.accesses());
  EXPECT_EQ(table.list({}).names.size(), 3U);
  EXPECT_EQ(table.list({}).prefixes, (std::vector<std::string>{"arm", "robot"}));
  EXPECT_EQ(table.list({{"arm"}, 1}).names,
            (std::vector<std::string>{"arm.speed_scale", "arm.dry_run"}));
  EXPECT_TRUE(table.list({{}, 1}).names.empty());
  EXPECT_TRUE(table.list({{"ar"}, 0}).names.empty());
}

TEST(ParameterTable, RefusesWithAReason) {
  Settings settings;
  const ParameterTable table(settings.accesses());
  EXPECT_EQ(table.set({"x", parameter_value(true)}).reason, "there is no parameter 'x'");
  EXPECT_EQ(table.set({"robot.name", parameter_value(std::string("y"))}).reason,
            "'robot.name' is read-only");
  EXPECT_EQ(table.set({"arm.dry_run", parameter_value(0.5)}).reason,
            "'arm.dry_run' takes a bool, not a double");
  EXPECT_EQ(table.set({"arm.dry_run", {}}).reason, "'arm.dry_run' takes a bool, not nothing");
  for (const double wrong : {0.0, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(table.set({"arm.speed_scale", parameter_value(wrong)}).successful) << wrong;
  }
  EXPECT_EQ(settings.speed_, 0.5);
  EXPECT_TRUE(table.set({"arm.speed_scale", parameter_value(std::int64_t{1})}).successful);
  EXPECT_EQ(settings.speed_, 1.0);
}

TEST(ParameterTable, SetsAllOrNone) {
  Settings settings;
  const ParameterTable table(settings.accesses());
  settings.dry_run_ = true;
  const auto result = table.set_all(
      {{"arm.speed_scale", parameter_value(0.7)}, {"arm.dry_run", parameter_value(false)}});
  EXPECT_FALSE(result.successful);
  EXPECT_EQ(result.reason, "it sticks");
  EXPECT_EQ(settings.speed_, 0.5);
}

TEST(Parameters, AreListedReadAndWrittenByServices) {
  Settings settings;
  const auto here = make_node("here");
  const auto there = make_node("there");
  const auto parameters = must(Parameters::make(*there, settings.accesses(), system_stamp));
  std::mutex mutex;
  std::vector<rcl_interfaces::ParameterEvent> events;
  const Subscription listening = must(here->subscribe<rcl_interfaces::ParameterEvent>(
      "/parameter_events", kDefaultQos, [&](auto&& event, const Guid&) {
        const std::lock_guard lock(mutex);
        events.push_back(event);
      }));
  using rcl_interfaces::DescribeParameters;
  using rcl_interfaces::GetParameters;
  using rcl_interfaces::GetParameterTypes;
  using rcl_interfaces::SetParameters;
  using rcl_interfaces::SetParametersAtomically;
  auto list = must(Client<ListParameters>::make(*here, "/there/list_parameters"));
  auto get = must(Client<GetParameters>::make(*here, "/there/get_parameters"));
  auto types = must(Client<GetParameterTypes>::make(*here, "/there/get_parameter_types"));
  auto describe = must(Client<DescribeParameters>::make(*here, "/there/describe_parameters"));
  auto set = must(Client<SetParameters>::make(*here, "/there/set_parameters"));
  auto all = must(Client<SetParametersAtomically>::make(*here, "/there/set_parameters_atomically"));
  ASSERT_TRUE(eventually([&] {
    return list.ready() && get.ready() && types.ready() && describe.ready() && set.ready() &&
           all.ready() && !listening->matched().empty();
  }));
  EXPECT_EQ(must(list.call({}, 10s)).result.names.size(), 3U);
  const auto values = must(get.call({{"robot.name", "nothing"}}, 10s)).values;
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].string_value, "picker");
  EXPECT_EQ(values[1].type, ParameterType::PARAMETER_NOT_SET);
  EXPECT_EQ(must(types.call({{"arm.dry_run"}}, 10s)).types.at(0), ParameterType::PARAMETER_BOOL);
  const auto speed = must(describe.call({{"arm.speed_scale"}}, 10s)).descriptors.at(0);
  EXPECT_EQ(speed.floating_point_range.at(0).to_value, 1.0);
  EXPECT_FALSE(speed.read_only);

  const auto results = must(set.call({{{"arm.speed_scale", parameter_value(0.3)},
                                       {"arm.speed_scale", parameter_value(3.0)}}},
                                     10s))
                           .results;
  ASSERT_EQ(results.size(), 2U);
  EXPECT_TRUE(results[0].successful);
  EXPECT_FALSE(results[1].successful);
  EXPECT_EQ(settings.speed_, 0.3);
  EXPECT_TRUE(must(all.call({{{"arm.dry_run", parameter_value(true)}}}, 10s)).result.successful);
  ASSERT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return events.size() == 2;
  }));
  EXPECT_EQ(events[0].node, "/there");
  EXPECT_EQ(events[1].changed_parameters.at(0).name, "arm.dry_run");
}

}  // namespace
}  // namespace canopeer::ros
