#include "canopeer/mission/mission.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "canopeer/mission/steering_desk.h"
#include "canopeer/robot/path_timing.h"
#include "mission_fixture.h"

namespace canopeer {
namespace {

/// A camera that breaks after some frames.
class FailingCamera : public Camera {
 public:
  FailingCamera(Camera& camera, int frames) : camera_(camera), left_(frames) {}
  Expected<RgbdFrame> capture() override {
    if (left_-- <= 0) return fail("cable pulled");
    return camera_.capture();
  }

 private:
  Camera& camera_;
  int left_;
};

TEST_F(MissionTest, WorksThroughItsSegmentsInTime) {
  Simulation simulation = simulate();
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  ASSERT_EQ(record_.segments.size(), 2U);
  EXPECT_FALSE(record_.interrupted);
  for (const auto& segment : record_.segments) {
    EXPECT_NEAR(segment.end_s - segment.start_s, options_.segment_time_s, 1e-9);
    int views = 0;
    for (const auto& view : record_.views) {
      if (view.segment != segment.segment) continue;
      EXPECT_EQ(view.target_kind == "home", views == 0);  // the first frame is taken at home
      ++views;
    }
    EXPECT_GE(views, 3);
  }
  // The clock is the sum of all that took time.
  double motion_s = 0.0;
  for (const auto& motion : record_.motions) {
    motion_s += motion.duration_s;
    EXPECT_FALSE(motion.collision);
  }
  EXPECT_LT(motion_s, record_.end_s);
  // What was written is what is in memory.
  const auto read = read_record(directory_);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->views.size(), record_.views.size());
  EXPECT_EQ(read->end_s, record_.end_s);
}

TEST_F(MissionTest, ItsRecordedMotionsKeepAllLimitsAndDoNotStopAtEveryCorner) {
  // Single views in a dense crop: few can be reached by one straight motion.
  options_.planner = "rvp";
  options_.segments = {{TrolleyState{1.0, 0.0}, 2, "side 2"}};
  options_.segment_time_s = 20.0;
  const RobotModel& robot = test::test_robot();
  const Scene dense = make_world(dense_1_world(), 1);
  Simulation simulation(robot, dense, robot.home("side_2"), TrolleyState{1.0, 0.0}, {});
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  const auto read = read_record(directory_);
  ASSERT_TRUE(read.has_value());
  const JointLimits& limits = robot.limits();
  int rounded = 0;
  for (const MotionEvent& event : read->motions) {
    if (event.kind == "trolley") continue;
    JointPath path;
    path.deviations = event.deviations;
    for (const auto& q : event.waypoints) {
      path.waypoints.emplace_back(
          Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
    }
    rounded += event.deviations.empty() ? 0 : 1;
    const PathMotion motion(path, limits);
    EXPECT_NEAR(motion.duration_s(), event.duration_s, 1e-6);
    EXPECT_FALSE(event.collision);
    for (double t_s = 0.0; t_s < motion.duration_s(); t_s += 0.002) {
      const Configuration q = motion.at(t_s);
      const Configuration speed = motion.velocity_at(t_s).cwiseAbs();
      const Configuration acceleration = motion.acceleration_at(t_s).cwiseAbs();
      ASSERT_TRUE((speed.array() <= limits.velocity.array() * (1.0 + 1e-9)).all());
      ASSERT_TRUE((acceleration.array() <= limits.acceleration.array() * (1.0 + 1e-9)).all());
      ASSERT_TRUE(robot.within_limits(q));
    }
  }
  EXPECT_GT(rounded, 0);
}

TEST_F(MissionTest, AnArmThatStopsBesideItsGoalStillGetsItsJobDone) {
  Simulation simulation = simulate(0.01);
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  EXPECT_EQ(record_.segments.size(), 2U);
  EXPECT_GE(record_.views.size(), 6U);
}

TEST_F(MissionTest, ACameraThatFailsEndsTheRunAndLosesNothing) {
  Simulation simulation = simulate();
  Ports ports = simulation.ports();
  FailingCamera camera(*ports.camera, 3);
  ports.camera = &camera;
  const auto outcome = run(simulation, ports);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("cable pulled"), std::string::npos);
  EXPECT_EQ(record_.views.size(), 3U);
  EXPECT_TRUE(record_.interrupted);
  const auto read = read_record(directory_);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->views.size(), 3U);
  EXPECT_TRUE(read->interrupted);
}

TEST_F(MissionTest, StopEndsItAfterTheMotionUnderWay) {
  SteeringPolicy policy("two views", [](const SteeringPoint& at) {
    return at.views >= 2 ? SteeringWord::Kind::stop : SteeringWord::Kind::go_on;
  });
  steering_ = &policy;
  Simulation simulation = simulate();
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  EXPECT_EQ(record_.views.size(), 2U);
  EXPECT_EQ(record_.segments.size(), 1U);
  EXPECT_TRUE(record_.interrupted);
  ASSERT_EQ(record_.steering.size(), 1U);
  EXPECT_EQ(record_.steering[0].said, "stop");
  EXPECT_EQ(record_.steering[0].by, "two views");
  // The arm is home all the same.
  EXPECT_EQ(record_.motions.back().kind, "home");
  const auto read = read_record(directory_);
  ASSERT_TRUE(read.has_value());
  ASSERT_EQ(read->steering.size(), 1U);
  EXPECT_EQ(read->steering[0].t_s, record_.steering[0].t_s);
}

TEST_F(MissionTest, TheNextSegmentCanBeAskedForBeforeTheTimeIsUp) {
  SteeringPolicy policy("one is enough", [](const SteeringPoint& at) {
    return at.segment == 0 && at.views == 3 ? SteeringWord::Kind::next_segment
                                            : SteeringWord::Kind::go_on;
  });
  steering_ = &policy;
  Simulation simulation = simulate();
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  ASSERT_EQ(record_.segments.size(), 2U);
  EXPECT_LT(record_.segments[0].end_s - record_.segments[0].start_s, options_.segment_time_s);
  EXPECT_NEAR(record_.segments[1].end_s - record_.segments[1].start_s, options_.segment_time_s,
              1e-9);
  EXPECT_FALSE(record_.interrupted);
}

TEST_F(MissionTest, APauseTakesNothingFromARunInSimulatedTime) {
  Simulation undisturbed = simulate();
  ASSERT_TRUE(run(undisturbed, undisturbed.ports()).has_value());
  const RunRecord expected = record_;
  int asked_while_holding = 0;
  SteeringPolicy policy("a break", [&](const SteeringPoint& at) {
    if (at.views != 2 || asked_while_holding == 3) return SteeringWord::Kind::go_on;
    asked_while_holding += at.holding ? 1 : 0;
    return SteeringWord::Kind::pause;
  });
  steering_ = &policy;
  Simulation simulation = simulate();
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  EXPECT_EQ(asked_while_holding, 3);
  EXPECT_EQ(record_.end_s, expected.end_s);
  ASSERT_EQ(record_.views.size(), expected.views.size());
  EXPECT_EQ(record_.views.back().q, expected.views.back().q);
  ASSERT_EQ(record_.steering.size(), 2U);  // the pause and its end
  EXPECT_EQ(record_.steering[1].said, "go_on");
}

/// Takes so many events, then its disk is full.
class FullDisk : public Keeper {
 public:
  Expected<void> on_event(const Event& event) override {
    ended = ended || std::holds_alternative<RunEnded>(event);
    if (left-- > 0) return {};
    return fail("disk full");
  }
  int left = 12;
  bool ended = false;
};

TEST_F(MissionTest, AKeeperThatFailsEndsTheRunAndTheOthersKeepAll) {
  FullDisk disk;
  other_keepers_ = {&disk};
  Simulation simulation = simulate();
  const auto outcome = run(simulation, simulation.ports());
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("disk full"), std::string::npos);
  EXPECT_TRUE(disk.ended);
  EXPECT_TRUE(record_.interrupted);
  ASSERT_EQ(record_.faults.size(), 1U);
  EXPECT_NE(record_.faults[0].message.find("disk full"), std::string::npos);
  EXPECT_GE(record_.views.size(), 1U);
  EXPECT_EQ(read_record(directory_)->views.size(), record_.views.size());
}

/// Refuses the first event.
class NoRoom : public Keeper {
 public:
  Expected<void> on_event(const Event& event) override {
    faults += std::holds_alternative<Fault>(event) ? 1 : 0;
    ends += std::holds_alternative<RunEnded>(event) ? 1 : 0;
    if (std::holds_alternative<RunBegun>(event)) return fail("no room");
    return {};
  }
  int faults = 0;
  int ends = 0;
};

TEST_F(MissionTest, AfterAFailureNothingGoesOnAndItEndsOnce) {
  Simulation simulation = simulate();
  const RobotKit robot{test::test_robot(), ik_, simulation.judge().checker()};
  Mission mission(robot, simulation.ports(), options_, Registries::built_in());
  NoRoom keeper;
  mission.keep(keeper);
  const auto first = mission.step();
  ASSERT_FALSE(first.has_value());
  EXPECT_EQ(first.error().message, "no room");
  EXPECT_FALSE(mission.step().has_value());
  EXPECT_FALSE(mission.state().has_value());
  EXPECT_TRUE(mission.end().has_value());
  EXPECT_FALSE(mission.end().has_value());
  EXPECT_EQ(keeper.faults, 1);
  EXPECT_EQ(keeper.ends, 1);
}

TEST_F(MissionTest, AnUnknownPlannerIsAFaultOfTheRecord) {
  options_.planner = "oracle";
  Simulation simulation = simulate();
  const auto outcome = run(simulation, simulation.ports());
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("there is: vmp"), std::string::npos);
  ASSERT_EQ(record_.faults.size(), 1U);
  EXPECT_TRUE(record_.interrupted);
}

TEST_F(MissionTest, WhatThrowsEndsTheRunLikeAnyFailure) {
  SteeringPolicy policy("broken", [](const SteeringPoint& at) -> SteeringWord::Kind {
    if (at.views == 2) throw std::runtime_error("no such table");
    return SteeringWord::Kind::go_on;
  });
  steering_ = &policy;
  Simulation simulation = simulate();
  const auto outcome = run(simulation, simulation.ports());
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("no such table"), std::string::npos);
  EXPECT_EQ(record_.views.size(), 2U);
}

TEST_F(MissionTest, ADetectorWhoseMaskHasAnotherSizeIsRefused) {
  class Half : public Detector {
    Expected<Detection> detect(const RgbdFrame&) const override {
      return Detection{Image<PixelLabel>(8, 8), Mask(8, 8), Image<float>(8, 8)};
    }
  };
  Registries registries = Registries::built_in();
  ASSERT_TRUE(registries.detectors
                  .add("half", "eight by eight",
                       [](const DetectorOptions&) -> Expected<std::unique_ptr<Detector>> {
                         return std::make_unique<Half>();
                       })
                  .has_value());
  options_.detector.kind = "half";
  Simulation simulation = simulate();
  const RobotKit robot{test::test_robot(), ik_, simulation.judge().checker()};
  Mission mission(robot, simulation.ports(), options_, registries);
  const auto outcome = mission.run();
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("640 × 480; it is 8 × 8"), std::string::npos)
      << outcome.error().message;
}

TEST_F(MissionTest, AnotherReasonToHoldIsSaidToo) {
  int asked = 0;
  class Reasons : public Steering {
   public:
    explicit Reasons(int& count) : asked_(count) {}
    SteeringWord ask(const SteeringPoint& at) override {
      if (at.views != 1 || asked_ == 4) return {};
      return {SteeringWord::Kind::wait_for_person, "trolley",
              ++asked_ < 3 ? "push it" : "a little back"};
    }

   private:
    int& asked_;
  } steering(asked);
  steering_ = &steering;
  Simulation simulation = simulate();
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  ASSERT_EQ(record_.steering.size(), 3U);
  EXPECT_EQ(record_.steering[0].why, "push it");
  EXPECT_EQ(record_.steering[1].why, "a little back");
  EXPECT_EQ(record_.steering[2].said, "go_on");
}

/// Notes the order of what happens.
class Diary : public Watcher {
 public:
  EventNeeds needs() const override { return {true, true}; }
  void on_event(const Event& event) override { events.push_back(event); }
  std::vector<Event> events;
};

TEST_F(MissionTest, AWatcherSeesEverythingAndChangesNothing) {
  Simulation alone = simulate();
  ASSERT_TRUE(run(alone, alone.ports()).has_value());
  const RunRecord expected = record_;
  Simulation simulation = simulate();
  const RobotKit robot{test::test_robot(), ik_, simulation.judge().checker()};
  Mission mission(robot, simulation.ports(), options_, Registries::built_in());
  simulation.watch_map(&mission.map());
  const auto diary = std::make_shared<Diary>();
  mission.watch(diary, {.name = "diary", .wait_in_simulated_time = true});
  ASSERT_TRUE(mission.run().has_value());
  ASSERT_EQ(mission.watched().front().lost, 0);

  ASSERT_FALSE(diary->events.empty());
  EXPECT_TRUE(std::holds_alternative<RunBegun>(diary->events.front()));
  EXPECT_TRUE(std::holds_alternative<RunEnded>(diary->events.back()));
  std::size_t views = 0;
  for (const Event& event : diary->events) {
    if (const auto* frame = std::get_if<FrameTaken>(&event)) {
      ASSERT_LT(views, expected.views.size());
      EXPECT_EQ(frame->view.q, expected.views[views].q);
      EXPECT_EQ(frame->frame->time_s, frame->view.t_s);
      EXPECT_EQ(frame->detection->fruit.width(), frame->frame->depth.width());
      ++views;
    }
    if (const auto* change = std::get_if<MapChanged>(&event)) {
      ASSERT_NE(change->map, nullptr);
      EXPECT_EQ(change->map->roi_voxels(), expected.views[views - 1].roi_voxels);
      EXPECT_FALSE(change->blocks.empty());
    }
    if (const auto* plan = std::get_if<Planned>(&event)) {
      ASSERT_NE(plan->sketch, nullptr);
      EXPECT_FALSE(plan->sketch->views.empty());
      EXPECT_GE(plan->waypoints.size(), 2U);
    }
  }
  EXPECT_EQ(views, expected.views.size());
}

}  // namespace
}  // namespace canopeer
