#include <gtest/gtest.h>

#include "canopeer/planner/playback/playback_planner.h"
#include "planner_fixture.h"

namespace canopeer {
namespace {

ViewPlan two_segments(const Configuration& home) {
  ViewPlan plan;
  plan.segments = {{home, home}, {home}};
  plan.segments[0][0][0] += 0.1;
  plan.segments[0][1][1] -= 0.1;
  plan.segments[1][0][2] += 0.1;
  return plan;
}

TEST(Playback, GoesStraightFromViewToViewAndIsDoneAtTheEnd) {
  const ViewPlan plan = two_segments(test::test_robot().home("side_1"));
  test::PlannerFixture run(std::make_unique<PlaybackPlanner>(plan));
  for (const Configuration& view : plan.segments[0]) {
    const Configuration before = run.q;
    ASSERT_TRUE(run.take_view());
    EXPECT_EQ(run.last.motion.waypoints, (std::vector<Configuration>{before, view}));
    EXPECT_EQ(run.q, view);
  }
  EXPECT_FALSE(run.take_view());
  EXPECT_EQ(run.last.action, Decision::Action::done);

  PlanningScene next = run.scene();
  next.segment.index = 1;
  run.planner->begin_segment(next);
  EXPECT_EQ(run.planner->decide(run.q, run.work).motion.waypoints.back(), plan.segments[1][0]);
  EXPECT_EQ(run.planner->decide(run.q, run.work).action, Decision::Action::done);
}

TEST(Playback, ChargesNothingForItsDecisions) {
  PlaybackPlanner planner(two_segments(test::test_robot().home("side_1")));
  test::PlannerFixture run("random", {});
  planner.begin_segment(run.scene());
  WorkMeter work;
  static_cast<void>(planner.decide(run.q, work));
  for (std::size_t i = 0; i < kWorkKinds; ++i) EXPECT_EQ(work.units(static_cast<Work>(i)), 0);
}

TEST(Playback, AStateGoesOnWithItsOwnPlanOnly) {
  const ViewPlan plan = two_segments(test::test_robot().home("side_1"));
  test::PlannerFixture run(std::make_unique<PlaybackPlanner>(plan));
  ASSERT_TRUE(run.take_view());
  const std::string state = run.planner->state().value();
  PlaybackPlanner heir(plan);
  ASSERT_TRUE(heir.restore(run.scene(), state).has_value());
  EXPECT_EQ(heir.decide(run.q, run.work).motion.waypoints.back(), plan.segments[0][1]);

  ViewPlan changed = plan;
  changed.segments[1][0][0] += 1e-12;
  const auto refused = PlaybackPlanner(changed).restore(run.scene(), state);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("not the one that this run began with"),
            std::string::npos);
}

TEST(Playback, ItsFactorySaysWhatIsWrong) {
  const RobotModel& robot = test::test_robot();
  PlannerOptions options;
  const auto error = [&] {
    const auto made = PlannerRegistry::built_in().make("playback", options);
    return made ? std::string("no error") : made.error().message;
  };
  EXPECT_NE(error().find("set playback.plan"), std::string::npos);
  options.playback.plan = std::filesystem::temp_directory_path() / "canopeer_playback_test.json";
  std::filesystem::remove(options.playback.plan);
  EXPECT_NE(error().find(options.playback.plan.string()), std::string::npos);
  ASSERT_TRUE(write_view_plan(options.playback.plan, two_segments(robot.home("side_1"))));
  EXPECT_EQ(error(), "no error");
  options.playback.fit = PlanFit{2, robot.limits()};
  EXPECT_EQ(error(), "no error");
  options.playback.fit->segments = 3;
  EXPECT_NE(error().find(options.playback.plan.string() + ": it has 2 segments"),
            std::string::npos);
  std::filesystem::remove(options.playback.plan);
}

}  // namespace
}  // namespace canopeer
