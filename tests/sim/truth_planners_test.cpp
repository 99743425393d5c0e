#include "canopeer/sim/truth_planners.h"

#include <gtest/gtest.h>

#include "../planner/planner_fixture.h"

namespace canopeer {
namespace {

PlannerRegistry with_truth() {
  PlannerRegistry planners = PlannerRegistry::built_in();
  add_truth_planners(planners);
  return planners;
}

TEST(TruthPlanners, WithoutTheTruthTheyCannotBeMade) {
  const PlannerRegistry planners = with_truth();
  for (const char* name : {"vmp_true", "nbs_true"}) {
    EXPECT_TRUE(planners.manners(name).knows_truth);
    EXPECT_FALSE(planners.one_line(name).empty());
    const auto planner = planners.make(name, {});
    ASSERT_FALSE(planner.has_value());
    EXPECT_NE(planner.error().message.find(name), std::string::npos);
    EXPECT_NE(planner.error().message.find("only a simulation knows"), std::string::npos);
  }
  EXPECT_FALSE(planners.manners("vmp").knows_truth);
}

class TruthPlanner : public ::testing::TestWithParam<const char*> {
 protected:
  TruthPlanner() {
    const test::PlanningFixture world;
    tell_truth(world.scene, options_);
  }
  [[nodiscard]] std::unique_ptr<Planner> make() const {
    return std::move(*with_truth().make(GetParam(), options_));
  }

  PlannerOptions options_;
};

TEST_P(TruthPlanner, GoesWhereFruitIsToBeSeen) {
  test::PlannerFixture run(make());
  std::int64_t wished = 0;
  const std::int64_t before = run.world.perception.map().roi_voxels();
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(run.take_view());
    wished += run.last.motion.predicted_gain.value();
  }
  EXPECT_GT(wished, 50);
  EXPECT_GT(run.world.perception.map().roi_voxels() - before, wished / 2);
}

TEST_P(TruthPlanner, GoesOnFromAStateAsIfNothingHadHappened) {
  test::PlannerFixture run(make());
  ASSERT_TRUE(run.take_view());
  ASSERT_TRUE(run.take_view());
  const std::string state = run.planner->state().value();
  const auto heir = make();
  ASSERT_TRUE(heir->restore(run.scene(), state).has_value());
  EXPECT_TRUE(heir->state().value() == state);
  WorkMeter a;
  WorkMeter b;
  const Decision went_on = run.planner->decide(run.q, a);
  const Decision restored = heir->decide(run.q, b);
  EXPECT_EQ(went_on.action, restored.action);
  EXPECT_EQ(went_on.motion.waypoints, restored.motion.waypoints);
  EXPECT_EQ(went_on.motion.predicted_gain, restored.motion.predicted_gain);
  EXPECT_EQ(a.units(Work::view_cast), b.units(Work::view_cast));
}

INSTANTIATE_TEST_SUITE_P(All, TruthPlanner, ::testing::Values("vmp_true", "nbs_true"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace canopeer
