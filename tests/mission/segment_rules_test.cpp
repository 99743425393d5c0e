#include <algorithm>
#include <cmath>
#include <map>

#include "canopeer/mission/mission_time.h"
#include "canopeer/mission/segment/segment_course.h"
#include "canopeer/mission/steering_desk.h"
#include "canopeer/robot/straight_timing.h"
#include "mission_fixture.h"

// What ends a segment beside its time, and what is measured on the way.

namespace canopeer {
namespace {

/// A metre along the row.
double axis_drive_s(const RobotModel& robot) {
  return axis_motion_time(1.0, robot.travel_axis().velocity_limit,
                          robot.travel_axis().acceleration_limit);
}

class SegmentRules : public MissionTest {
 protected:
  void SetUp() override {
    MissionTest::SetUp();
    options_.planner = "random";
  }

  void run_it() {
    Simulation simulation = simulate();
    const auto outcome = run(simulation, simulation.ports());
    ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
  }

  [[nodiscard]] std::map<int, int> views() const {
    std::map<int, int> count;
    for (const ViewEvent& view : record_.views) ++count[view.segment];
    return count;
  }
};

TEST_F(SegmentRules, SoManyViewsAndNoTimeLimit) {
  options_.segment_time_s = 0.0;
  options_.max_views = 4;
  run_it();
  EXPECT_EQ(views(), (std::map<int, int>{{0, 4}, {1, 4}}));
  EXPECT_FALSE(record_.interrupted);
  // The home view counts; the segment ends with its last view.
  EXPECT_EQ(record_.views.front().target_kind, "home");
  EXPECT_GE(record_.segments[0].end_s, record_.views[3].t_s);
  EXPECT_LT(record_.segments[0].end_s, record_.views[3].t_s + 1.0);
}

TEST_F(SegmentRules, TimeEndsASegmentThatHasViewsLeft) {
  options_.max_views = 1000;
  run_it();
  EXPECT_NEAR(record_.segments[0].end_s - record_.segments[0].start_s, options_.segment_time_s,
              1e-9);
}

TEST_F(SegmentRules, AFixedScanSaysWhenItIsDone) {
  options_.planner = "coverage";
  options_.planners.coverage.scan.spacing_m = 0.4;
  options_.segments.resize(1);
  options_.segment_time_s = 0.0;
  options_.leave_when_done = true;
  run_it();
  const std::size_t all = record_.views.size();
  EXPECT_GT(all, 3U);
  EXPECT_FALSE(record_.interrupted);
  // With much time it takes the same views and waits.
  options_.segment_time_s = 200.0;
  options_.leave_when_done = false;
  run_it();
  EXPECT_EQ(record_.views.size(), all);
  EXPECT_GT(record_.time->waiting_s, 1.0);
}

/// Waits for ever, or is stuck, whatever happens.
class Idle : public Planner {
 public:
  explicit Idle(Decision::Action action) : action_(action) {}
  void begin_segment(const PlanningScene& scene) override { left_s = scene.time_left_s; }
  Decision decide(const Configuration&, WorkMeter&) override {
    Decision decision;
    decision.action = action_;
    return decision;
  }
  inline static double left_s = 0.0;

 private:
  Decision::Action action_;
};

TEST_F(SegmentRules, WithoutATimeLimitWhoKnowsNoWayOnIsDone) {
  options_.segment_time_s = 0.0;
  options_.leave_when_done = true;
  options_.planner = "idle";
  for (const auto action : {Decision::Action::wait, Decision::Action::stuck}) {
    Registries registries = Registries::built_in();
    ASSERT_TRUE(registries.planners.add("idle", "does nothing", [&](const PlannerOptions&) {
      return std::make_unique<Idle>(action);
    }));
    Simulation simulation = simulate();
    const RobotKit robot{test::test_robot(), ik_, simulation.judge().checker()};
    Mission mission(robot, simulation.ports(), options_, registries);
    auto keeper = RecordKeeper::create(directory_, {});
    mission.keep(*keeper);
    ASSERT_TRUE(mission.run().has_value());
    EXPECT_EQ(keeper->record().segments.size(), 2U);
    EXPECT_EQ(keeper->record().views.size(), 2U);  // at home
    EXPECT_LT(keeper->record().end_s, 100.0);
    EXPECT_TRUE(std::isinf(Idle::left_s));
  }
}

TEST_F(SegmentRules, OneBudgetIsSharedByWhatIsLeft) {
  const RobotModel& robot = test::test_robot();
  options_.segments.push_back({TrolleyState{2.0, 0.0}, 2, "farther"});
  options_.clock = MissionClock::whole;
  options_.shares_time = true;
  options_.mission_time_s = whole_mission_time_s(robot, options_);
  const double t = options_.segment_time_s;
  const double transitions_s = options_.mission_time_s - 3 * t;
  // Who begins in time gets the same; who left early leaves it to the others; the last gets all.
  EXPECT_NEAR(shared_time_s(robot, options_, 0, 0.0), t, 1e-9);
  const double second_s = 1.0;
  const double to_last_s = axis_drive_s(robot);
  EXPECT_NEAR(shared_time_s(robot, options_, 1, second_s),
              (options_.mission_time_s - second_s - to_last_s) / 2, 1e-9);
  EXPECT_NEAR(shared_time_s(robot, options_, 2, second_s), options_.mission_time_s - second_s,
              1e-9);
  EXPECT_LT(shared_time_s(robot, options_, 2, options_.mission_time_s + 1.0), 0.0);
  EXPECT_GT(transitions_s, to_last_s);
}

TEST_F(SegmentRules, WhoLeavesEarlyGivesTheTimeToThoseBehind) {
  options_.segment_time_s = 12.0;
  options_.clock = MissionClock::whole;
  options_.leave_when_done = true;
  options_.mission_time_s = whole_mission_time_s(test::test_robot(), options_);
  options_.shares_time = true;
  SteeringPolicy policy("early", [](const SteeringPoint& at) {
    return at.segment == 0 && at.views == 2 ? SteeringWord::Kind::next_segment
                                            : SteeringWord::Kind::go_on;
  });
  steering_ = &policy;
  run_it();
  ASSERT_EQ(record_.segments.size(), 2U);
  const double first_s = record_.segments[0].end_s - record_.segments[0].start_s;
  const double second_s = record_.segments[1].end_s - record_.segments[1].start_s;
  EXPECT_LT(first_s, 10.0);
  EXPECT_GT(second_s, 14.0);
  EXPECT_NEAR(record_.segments[1].end_s, options_.mission_time_s, 1e-9);
}

TEST_F(SegmentRules, AllOfTheTimeIsBookedOnce) {
  for (const char* planner : {"vmp", "random"}) {
    options_.planner = planner;
    run_it();
    ASSERT_TRUE(record_.time.has_value());
    const TimeSplit& t = *record_.time;
    EXPECT_NEAR(t.mapping_s + t.planning_s + t.execution_s + t.waiting_s + t.transitions_s,
                record_.end_s, 1e-9);
    double motions_s = 0.0;
    for (const MotionEvent& motion : record_.motions) {
      motions_s += motion.kind == "view" ? motion.duration_s : 0.0;
    }
    EXPECT_GE(t.execution_s, motions_s - 1e-9);
    EXPECT_LT(t.execution_s, motions_s + 2.0);
    EXPECT_GT(t.mapping_s, 0.0);
    EXPECT_GT(t.transitions_s, 0.0);
    const auto read = read_record(directory_);
    EXPECT_EQ(read->time->mapping_s, t.mapping_s);
  }
}

TEST_F(SegmentRules, GainIsRealisedWithinWhatThePlannersRaysCross) {
  options_.planner = "vmp";
  run_it();
  int predicted = 0;
  for (const ViewEvent& view : record_.views) {
    EXPECT_EQ(view.realised_in_fan.has_value(), view.predicted_gain.has_value());
    if (!view.realised_in_fan) continue;
    ++predicted;
    // A share of all that became known, and no more than rays of 0.3 m can cross.
    EXPECT_LE(*view.realised_in_fan, view.realised_gain);
    const ViewFan& fan = options_.planners.vmp.path_search.fan;
    EXPECT_LE(*view.realised_in_fan, fan.rows * fan.columns * 60);
  }
  EXPECT_GT(predicted, 2);
}

TEST_F(SegmentRules, TheCamerasPathIsThatOfItsPlaces) {
  run_it();
  const RobotModel& robot = test::test_robot();
  ASSERT_FALSE(record_.motions.empty());
  for (const MotionEvent& motion : record_.motions) {
    ASSERT_TRUE(motion.camera_path_m.has_value());
    if (motion.kind == "trolley" || motion.waypoints.size() != 2) continue;
    // By many small steps along the one straight line.
    const auto at = [&](double s) {
      Configuration q(motion.waypoints[0].size());
      for (Eigen::Index i = 0; i < q.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        q[i] = (1 - s) * motion.waypoints[0][k] + s * motion.waypoints[1][k];
      }
      return Vec3(robot.T_base_camera(q).translation());
    };
    double length_m = 0.0;
    for (int i = 0; i < 2000; ++i) length_m += (at((i + 1) / 2000.0) - at(i / 2000.0)).norm();
    EXPECT_NEAR(*motion.camera_path_m, length_m, 0.002 * length_m + 1e-6);
    EXPECT_GE(length_m, (at(1.0) - at(0.0)).norm() - 1e-9);
  }
}

TEST(SegmentCourse, IsExhaustedWhenTheLastViewsBroughtNextToNothing) {
  SegmentCourse course;
  course.begin(1000);
  std::int64_t known = 1000;
  const auto view = [&](std::int64_t gain) { course.viewed(known += gain); };
  view(100000);
  EXPECT_FALSE(course.exhausted());
  for (int i = 0; i < 5; ++i) view(10);
  EXPECT_EQ(course.views(), 6);
  EXPECT_TRUE(course.exhausted());  // 50 of 100 050
  view(500);
  EXPECT_FALSE(course.exhausted());
  for (int i = 0; i < 4; ++i) view(0);
  EXPECT_FALSE(course.exhausted());  // the 500 are among the last five
  view(0);
  EXPECT_TRUE(course.exhausted());
  course.begin(known);
  EXPECT_FALSE(course.exhausted());
  EXPECT_EQ(course.views(), 0);
}

TEST(SegmentCourse, WaitsForGoodOnlyInARow) {
  SegmentCourse course;
  course.begin(0);
  for (int i = 0; i < SegmentCourse::kMostWaits - 1; ++i) course.waited();
  EXPECT_FALSE(course.waits_for_good());
  course.went_on();
  course.waited();
  EXPECT_FALSE(course.waits_for_good());
  for (int i = 0; i < SegmentCourse::kMostWaits; ++i) course.waited();
  EXPECT_TRUE(course.waits_for_good());
}

}  // namespace
}  // namespace canopeer
