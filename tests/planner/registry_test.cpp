#include "canopeer/planner/registry.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

TEST(PlannerRegistry, MakesEveryPlannerItLists) {
  for (const auto& name : planner_names()) {
    EXPECT_TRUE(make_planner(name, {}).has_value()) << name;
  }
}

TEST(PlannerRegistry, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const auto planner = make_planner("vpm", {});
  ASSERT_FALSE(planner.has_value());
  EXPECT_NE(planner.error().message.find("'vpm'"), std::string::npos);
  EXPECT_NE(planner.error().message.find("vmp"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
