#include <algorithm>
#include <cmath>

#include "canopeer/mission/mission_time.h"
#include "canopeer/record/fruit_course.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/straight_timing.h"
#include "mission_fixture.h"

// Frames taken while the arm or the trolley moves, and the clock that never stops.

namespace canopeer {
namespace {

class OnTheWay : public MissionTest {
 protected:
  void SetUp() override {
    MissionTest::SetUp();
    options_.on_the_way.hz = 10.0;
    options_.on_the_way.max_blur_px = 0.0;
  }

  void run_it() {
    Simulation simulation = simulate();
    const auto outcome = run(simulation, simulation.ports());
    ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
  }

  [[nodiscard]] FrameCounts counts() const {
    FrameCounts all;
    for (const MotionEvent& motion : record_.motions) {
      if (!motion.frames) continue;
      all.fused += motion.frames->fused;
      all.late += motion.frames->late;
      all.blurred += motion.frames->blurred;
      all.alike += motion.frames->alike;
    }
    return all;
  }

  void run_by_one_clock() {
    options_.clock = MissionClock::whole;
    options_.mission_time_s = whole_mission_time_s(test::test_robot(), options_);
    run_it();
  }
};

/// The motion under way at that time, or not longer than `slack_s` before or after; null: none.
const MotionEvent* motion_at(const RunRecord& record, double t_s, double slack_s = 1e-9) {
  for (const MotionEvent& motion : record.motions) {
    if (motion.start_s - slack_s <= t_s && t_s <= motion.start_s + motion.duration_s + slack_s) {
      return &motion;
    }
  }
  return nullptr;
}

JointPath path_of(const MotionEvent& motion) {
  JointPath path;
  for (const auto& q : motion.waypoints) {
    path.waypoints.push_back(Eigen::Map<const Eigen::VectorXd>(q.data(), 6));
  }
  path.deviations = motion.deviations;
  return path;
}

TEST_F(OnTheWay, NoneAreTakenUnlessAskedFor) {
  options_.on_the_way.hz = 0.0;
  run_it();
  EXPECT_TRUE(record_.frames.empty());
  for (const MotionEvent& motion : record_.motions) EXPECT_FALSE(motion.frames.has_value());
}

TEST_F(OnTheWay, EachIsFromWhereTheArmWasAtItsTime) {
  run_it();
  ASSERT_GT(record_.frames.size(), 20U);
  EXPECT_EQ(static_cast<int>(record_.frames.size()), counts().fused);
  const RobotModel& robot = test::test_robot();
  double last_s = -1.0;
  for (const FrameEvent& frame : record_.frames) {
    EXPECT_GT(frame.t_s, last_s);
    last_s = frame.t_s;
    EXPECT_NEAR(frame.t_s * 10.0, std::round(frame.t_s * 10.0), 1e-6);
    const MotionEvent* motion = motion_at(record_, frame.t_s);
    ASSERT_NE(motion, nullptr) << frame.t_s;
    EXPECT_EQ(frame.during, motion->kind);
    const PathMotion timed(path_of(*motion), robot);
    const Pose T =
        robot.T_world_base({1.0, 0.0}) * robot.T_base_camera(timed.at(frame.t_s - motion->start_s));
    EXPECT_TRUE(T.isApprox(frame.T_world_camera, 1e-9));
    EXPECT_GT(frame.fused_points, 0);
  }
}

TEST_F(OnTheWay, TheyFindFruitBetweenViews) {
  run_it();
  const auto first = first_known(fruit_course(record_));
  EXPECT_TRUE(std::any_of(first.begin(), first.end(),
                          [](const auto& fruit) { return fruit.second.on_the_way; }));
  EXPECT_TRUE(std::any_of(record_.frames.begin(), record_.frames.end(),
                          [](const FrameEvent& frame) { return frame.realised_gain > 0; }));
}

TEST_F(OnTheWay, TheRecordReadsBackAsItWas) {
  run_it();
  const auto read = read_record(directory_);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->frames.size(), record_.frames.size());
  for (std::size_t i = 0; i < read->frames.size(); ++i) {
    const FrameEvent& a = read->frames[i];
    const FrameEvent& b = record_.frames[i];
    EXPECT_EQ(a.t_s, b.t_s);
    EXPECT_EQ(a.during, b.during);
    EXPECT_EQ(a.blur_px, b.blur_px);
    ASSERT_EQ(a.fruits.size(), b.fruits.size());
    for (std::size_t k = 0; k < a.fruits.size(); ++k) {
      EXPECT_EQ(a.fruits[k].id, b.fruits[k].id);
      EXPECT_EQ(a.fruits[k].centre, b.fruits[k].centre);
      EXPECT_EQ(a.fruits[k].volume_cm3, b.fruits[k].volume_cm3);
      EXPECT_EQ(a.fruits[k].confidence, b.fruits[k].confidence);
    }
  }
}

TEST_F(OnTheWay, WhoComesWhileTooManyWaitIsLate) {
  run_it();
  const FrameCounts quick = counts();
  EXPECT_EQ(quick.late, 0);
  options_.costs[Work::detect_frame] = 0.4;  // of a camera of 10 Hz
  run_it();
  const FrameCounts slow = counts();
  EXPECT_GT(slow.late, 0);
  EXPECT_GT(slow.fused, 0);
  double moved_s = 0.0;
  int motions = 0;
  for (const MotionEvent& motion : record_.motions) {
    if (!motion.frames) continue;
    moved_s += motion.duration_s;
    ++motions;
  }
  // What the core had time for, and the queue at each end.
  EXPECT_LE(slow.fused, moved_s / 0.4 + motions * (1 + options_.on_the_way.queue));
}

TEST_F(OnTheWay, BlurredAndAlikeOnesAreLeftOut) {
  options_.on_the_way.max_blur_px = 1e-6;
  run_it();
  EXPECT_TRUE(record_.frames.empty());
  EXPECT_GT(counts().blurred, 0);
  options_.on_the_way.max_blur_px = 1.0;
  run_it();
  EXPECT_FALSE(record_.frames.empty());
  for (const FrameEvent& frame : record_.frames) EXPECT_LE(frame.blur_px, 1.02);
  options_.on_the_way.max_blur_px = 0.0;
  options_.on_the_way.new_after_m = 0.2;
  options_.on_the_way.new_after_rad = 0.5;
  run_it();
  EXPECT_GT(counts().alike, counts().fused);
}

TEST_F(OnTheWay, KeptSharpTheArmMovesNoFasterThanTheLimit) {
  options_.on_the_way.keep_sharp = true;
  options_.on_the_way.max_blur_px = 0.5;
  run_it();
  ASSERT_FALSE(record_.frames.empty());
  const ImageMotionLimit limit = *options_.on_the_way.limit();
  const RobotModel& robot = test::test_robot();
  for (const MotionEvent& motion : record_.motions) {
    if (motion.kind != "view") continue;
    JointPath path = path_of(motion);
    path.sharp = limit;
    const PathMotion timed(path, robot);
    EXPECT_NEAR(timed.duration_s(), motion.duration_s, 1e-6);
    for (double t_s = 0.01; t_s < timed.duration_s(); t_s += 0.02) {
      const CameraTwist twist = twist_between(robot.T_base_camera(timed.at(t_s - 1e-4)),
                                              robot.T_base_camera(timed.at(t_s + 1e-4)), 2e-4);
      EXPECT_LE(image_speed(twist, limit.camera, limit.distance_m), limit.speed_px_s * 1.0001);
    }
  }
}

TEST_F(OnTheWay, OnTheWallClockAThreadTakesThemIn) {
  options_.segments.resize(1);
  options_.segment_time_s = 3.0;
  options_.background_workers = 1;
  SimulationOptions simulated;
  simulated.realtime = true;
  const RobotModel& robot = test::test_robot();
  Simulation simulation(robot, scene_, robot.home("side_1"), TrolleyState{1.0, 0.0}, simulated);
  const auto outcome = run(simulation, simulation.ports());
  ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
  EXPECT_EQ(static_cast<int>(record_.frames.size()), counts().fused);
  EXPECT_GT(record_.frames.size(), 0U);
  for (const FrameEvent& frame : record_.frames) {
    EXPECT_NE(motion_at(record_, frame.t_s, 0.5), nullptr) << frame.t_s;
  }
}

TEST_F(OnTheWay, ACameraThatGivesNoneEndsTheRunWithAWord) {
  class StillCamera : public Camera {
   public:
    explicit StillCamera(Camera& camera) : camera_(camera) {}
    Expected<RgbdFrame> capture() override { return camera_.capture(); }

   private:
    Camera& camera_;
  };
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  StillCamera camera(*ports.camera);
  ports.camera = &camera;
  const auto outcome = run(simulation, ports);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().message, "camera: this camera gives no frames while it moves");
}

TEST_F(OnTheWay, ImagesThatCannotBeReadAreCountedAndTheRunGoesOn) {
  class SpoiltCamera : public Camera {
   public:
    explicit SpoiltCamera(Camera& camera) : camera_(camera) {}
    Expected<RgbdFrame> capture() override { return camera_.capture(); }
    Expected<void> stream(double hz) override { return camera_.stream(hz); }
    Expected<std::vector<StreamedFrame>> arrived() override {
      auto frames = camera_.arrived();
      for (StreamedFrame& frame : *frames) {
        frame.images = []() -> Expected<RgbdFrame> { return fail("half a message"); };
      }
      return frames;
    }

   private:
    Camera& camera_;
  };
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  SpoiltCamera camera(*ports.camera);
  ports.camera = &camera;
  ASSERT_TRUE(run(simulation, ports).has_value());
  EXPECT_TRUE(record_.frames.empty());
  int unread = 0;
  for (const MotionEvent& motion : record_.motions)
    unread += motion.frames ? motion.frames->unread : 0;
  EXPECT_GT(unread, 0);
}

TEST_F(OnTheWay, AMissionsTimeIsThatOfItsBudgetsAndFastestTransitions) {
  const RobotModel& robot = test::test_robot();
  const double two = whole_mission_time_s(robot, options_);
  EXPECT_GT(two, 2 * options_.segment_time_s);  // the arm has to turn to the other side
  options_.segments.push_back({TrolleyState{2.0, 0.0}, 2, "farther"});
  const double drive_s = axis_motion_time(1.0, robot.travel_axis().velocity_limit,
                                          robot.travel_axis().acceleration_limit);
  EXPECT_NEAR(whole_mission_time_s(robot, options_), two + drive_s + options_.segment_time_s, 1e-9);
  options_.mission_time_s = 2.0 * whole_mission_time_s(robot, options_);
  const auto deadlines = segment_deadlines_s(robot, options_);
  ASSERT_EQ(deadlines.size(), 3U);
  EXPECT_NEAR(deadlines[0], 2 * options_.segment_time_s, 1e-9);
  EXPECT_EQ(deadlines[2], options_.mission_time_s);
}

TEST_F(OnTheWay, NothingCountsAfterTheMissionsTime) {
  run_by_one_clock();
  EXPECT_GE(record_.end_s, options_.mission_time_s);
  ASSERT_FALSE(record_.views.empty());
  EXPECT_LE(record_.views.back().t_s, options_.mission_time_s);
  EXPECT_LE(record_.frames.back().t_s, options_.mission_time_s);
  const auto deadlines = segment_deadlines_s(test::test_robot(), options_);
  for (std::size_t i = 0; i < record_.segments.size(); ++i) {
    EXPECT_LE(record_.segments[i].end_s, deadlines[i] + 1e-9);
  }
}

}  // namespace
}  // namespace canopeer
