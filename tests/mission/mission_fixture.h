#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/mission/mission.h"
#include "canopeer/mission/record_keeper.h"
#include "canopeer/scene/worlds.h"
#include "support/planning_fixture.h"

namespace canopeer {

/// A short simulated mission of two segments, with ports that a test may replace.
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
    const RobotKit robot{test::test_robot(), ik_, simulation.judge().checker()};
    Mission mission(robot, ports, options_, Registries::built_in());
    simulation.watch_map(&mission.map());
    auto keeper = RecordKeeper::create(directory_, {});
    mission.keep(*keeper);
    if (steering_ != nullptr) mission.steer(*steering_);
    for (Keeper* other : other_keepers_) mission.keep(*other);
    const auto outcome = mission.run();
    record_ = keeper->record();
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
  Steering* steering_ = nullptr;
  std::vector<Keeper*> other_keepers_;
  RunRecord record_;
  std::filesystem::path directory_;
};

}  // namespace canopeer
