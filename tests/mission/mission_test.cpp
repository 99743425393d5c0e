#include "canopeer/mission/mission.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/robot/timing/path_timing.h"
#include "canopeer/scene/worlds.h"
#include "support/planning_fixture.h"

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

class MissionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 ("canopeer_mission_" +
                  std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(directory_);
    for (const int side : {1, 2}) {
      options_.segments.push_back({TrolleyState{1.0, 0.0}, side, "side " + std::to_string(side)});
    }
    options_.segment_time_s = 6.0;
    options_.costs[Work::fuse_point] = 1e-7;
    options_.costs[Work::candidate] = 1e-4;
    options_.costs[Work::view_cast] = 1e-4;
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  /// Runs the mission over `ports`, whatever they are made of.
  Expected<void> run(Simulation& simulation, const Ports& ports) {
    Mission mission(test::test_robot(), ik_, simulation.judge().checker(), ports, options_, stop_);
    return run(simulation, mission);
  }
  Expected<void> run(Simulation& simulation, Mission& mission) {
    simulation.watch_map(&mission.map());
    mission.on_progress([this](const MissionProgress& p) {
      EXPECT_LE(p.fraction, 1.0);
      if (p.views == stop_after_views_) stop_ = true;
    });
    auto writer = RecordWriter::create(directory_, {});
    const auto outcome = mission.run(*writer);
    record_ = mission.record();
    return outcome;
  }

  Simulation simulate(double arrival_error_rad = 0.0) {
    SimulationOptions options;
    options.arrival_error_rad = arrival_error_rad;
    const RobotModel& robot = test::test_robot();
    return {robot, scene_, robot.home("side_1"), TrolleyState{1.0, 0.0}, options};
  }

  const ArmIk ik_ = *ArmIk::make(test::test_robot());
  const Scene scene_ = make_world(scenario_1_world(), 1);
  MissionOptions options_;
  std::atomic<bool> stop_{false};
  int stop_after_views_ = -1;
  RunRecord record_;
  std::filesystem::path directory_;
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
  stop_after_views_ = 2;
  Simulation simulation = simulate();
  ASSERT_TRUE(run(simulation, simulation.ports()).has_value());
  EXPECT_EQ(record_.views.size(), 2U);
  EXPECT_TRUE(record_.interrupted);
}

}  // namespace
}  // namespace canopeer
