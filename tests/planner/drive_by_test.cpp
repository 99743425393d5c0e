#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "canopeer/planner/drive_by/drive_by_planner.h"
#include "canopeer/planner/drive_by/drive_speed.h"
#include "canopeer/robot/arm_extent.h"
#include "canopeer/sensing/camera_twist.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

/// A segment along a row with three stops at two lift heights. Arm and trolley are where the
/// planner sends them.
class DriveByTest : public ::testing::Test {
 protected:
  struct Step {
    Decision decision;
    Configuration q;       // where the arm is then
    TrolleyState trolley;  // before it
  };

  static DriveByOptions options(int poses, double tilt_rad, double overrun_m = 0.5) {
    DriveByOptions options;
    options.poses = poses;
    options.tilt_rad = tilt_rad;
    options.overrun_m = overrun_m;
    return options;
  }
  void begin(const DriveByOptions& options) {
    planner_ = std::make_unique<DriveByPlanner>(options);
    options_ = options;
    place({1.0, 0.0});
    planner_->begin_segment(scene());
  }
  PlanningScene scene() const {
    PlanningScene scene;
    scene.robot = &world_.robot;
    scene.ik = &world_.ik;
    scene.map = &world_.perception.map();
    scene.checker = checker_.get();
    scene.segment = world_.frame;
    scene.segment.trolley = trolley_;
    scene.segment.T_world_base = world_.robot.T_world_base(trolley_);
    scene.segment.sampling_region_world =
        transformed(world_.robot.sampling_region(1), scene.segment.T_world_base);
    scene.segment.row = row_;
    scene.sharp = sharp_;
    scene.looks_on_the_way = looks_on_the_way_;
    return scene;
  }
  void place(const TrolleyState& trolley) {
    trolley_ = trolley;
    checker_ = std::make_unique<CollisionChecker>(world_.robot, trolley_);
  }
  /// Until it waits or is stuck.
  std::vector<Step> until_it_rests() {
    std::vector<Step> steps;
    for (int i = 0; i < 200; ++i) {
      steps.push_back({planner_->decide(q_, work_), q_, trolley_});
      const Decision& decision = steps.back().decision;
      if (decision.action == Decision::Action::move) {
        q_ = decision.motion.waypoints.back();
      } else if (decision.action == Decision::Action::drive) {
        place(decision.drive.goal);
        planner_->moved(scene());
      } else {
        return steps;
      }
      if (take_over_) hand_over();
    }
    ADD_FAILURE() << "it never rests";
    return steps;
  }
  /// Another planner takes its place.
  void hand_over() {
    const std::string state = planner_->state().value();
    planner_ = std::make_unique<DriveByPlanner>(options_);
    ASSERT_TRUE(planner_->restore(scene(), state));
    EXPECT_EQ(planner_->state().value(), state);
  }
  static std::vector<TrolleyState> drives(const std::vector<Step>& steps) {
    std::vector<TrolleyState> goals;
    for (const Step& step : steps) {
      if (step.decision.action == Decision::Action::drive)
        goals.push_back(step.decision.drive.goal);
    }
    return goals;
  }

  test::PlanningFixture world_;
  std::vector<TrolleyState> row_ = {{1, 0}, {2, 0}, {2.5, 0}, {1, 0.5}, {2, 0.5}, {2.5, 0.5}};
  std::optional<ImageMotionLimit> sharp_;
  bool looks_on_the_way_ = true;
  std::unique_ptr<CollisionChecker> checker_;
  DriveByOptions options_;
  std::unique_ptr<DriveByPlanner> planner_;
  WorkMeter work_;
  Configuration q_ = world_.frame.home;
  TrolleyState trolley_;
  bool take_over_ = false;
};

TEST_F(DriveByTest, StopsToLookWhereNoFramesComeOnTheWay) {
  looks_on_the_way_ = false;
  begin(options(1, 0.0, 0.0));
  int drives = 0;
  double least = 1e9;
  double most = -1e9;
  for (const Step& step : until_it_rests()) {
    if (step.decision.action != Decision::Action::drive) continue;
    const double goal = step.decision.drive.goal.travel_m;
    EXPECT_LE(std::abs(goal - step.trolley.travel_m), 0.3 + 1e-9);
    least = std::min(least, goal);
    most = std::max(most, goal);
    ++drives;
  }
  EXPECT_GT(drives, (most - least) / 0.3);
  EXPECT_GT(most - least, 0.5);  // from end to end of the row
}

TEST_F(DriveByTest, DrivesToAndFroWithEachPoseAtEachLift) {
  begin(options(2, 0.0, 0.25));
  const auto steps = until_it_rests();
  EXPECT_EQ(steps.back().decision.action, Decision::Action::done);
  // Beyond the first stop, all along, and back; up; the same there.
  const std::vector<TrolleyState> wanted = {{0.75, 0},   {2.75, 0},   {0.75, 0},
                                            {0.75, 0.5}, {2.75, 0.5}, {0.75, 0.5}};
  const auto goals = drives(steps);
  ASSERT_EQ(goals.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(goals[i].travel_m, wanted[i].travel_m) << i;
    EXPECT_EQ(goals[i].lift_m, wanted[i].lift_m) << i;
  }
  EXPECT_EQ(
      std::count_if(steps.begin(), steps.end(),
                    [](const Step& s) { return s.decision.action == Decision::Action::move; }),
      4);
}

TEST_F(DriveByTest, TheParkedCameraLooksAtTheRowFromTheAisle) {
  begin(options(3, 0.4));
  std::vector<double> heights;
  int tilted = 0;
  for (const Step& step : until_it_rests()) {
    if (step.decision.action != Decision::Action::drive) continue;
    EXPECT_TRUE(keeps_to_aisle(world_.robot, step.q));
    const Pose T_base_camera = world_.robot.T_base_camera(step.q);
    const double towards = T_base_camera.linear().col(2).dot(Vec3::UnitY());
    if (towards > 1.0 - 1e-9) {
      heights.push_back(T_base_camera.translation().z());
    } else {
      EXPECT_NEAR(towards, std::cos(0.4), 1e-9);
      ++tilted;
    }
    EXPECT_LE(T_base_camera.translation().y(), 0.95 - 0.6 + 1e-9);
  }
  EXPECT_GT(tilted, 12);
  std::sort(heights.begin(), heights.end());
  ASSERT_FALSE(heights.empty());
  EXPECT_NEAR(heights.front(), 0.01 + 0.79 / 6.0, 1e-9);
  EXPECT_NEAR(heights.back(), 0.01 + 0.79 * 5.0 / 6.0, 1e-9);
}

TEST_F(DriveByTest, DrivesAsFastAsFramesStaySharp) {
  sharp_.emplace();
  sharp_->speed_px_s = 150.0;
  begin(options(1, 0.4));
  int looked_at = 0;
  for (const Step& step : until_it_rests()) {
    if (step.decision.action != Decision::Action::drive) continue;
    const double speed = step.decision.drive.max_travel_m_s;
    ASSERT_GT(speed, 0.0);
    // The camera a tenth of a second later.
    const auto camera = [&](double travel_m) {
      return world_.robot.T_world_base({travel_m, 0.0}) * world_.robot.T_base_camera(step.q);
    };
    const CameraTwist twist = twist_between(camera(1.0), camera(1.0 + 0.1 * speed), 0.1);
    EXPECT_NEAR(image_speed(twist, sharp_->camera, sharp_->distance_m), 150.0, 1e-6);
    ++looked_at;
  }
  EXPECT_GT(looked_at, 5);
}

TEST_F(DriveByTest, WithNoLimitItDrivesAsFastAsTheTrolleyCan) {
  begin(options(1, 0.0));
  for (const Step& step : until_it_rests()) {
    EXPECT_EQ(step.decision.drive.max_travel_m_s, 0.0);
  }
}

TEST_F(DriveByTest, CutAnywhereItGoesOnTheSame) {
  begin({});
  const auto steps = until_it_rests();
  q_ = world_.frame.home;
  take_over_ = true;
  begin({});
  const auto same = until_it_rests();
  ASSERT_EQ(same.size(), steps.size());
  for (std::size_t i = 0; i < same.size(); ++i) {
    EXPECT_EQ(same[i].decision.action, steps[i].decision.action);
    EXPECT_EQ(same[i].q, steps[i].q);
    EXPECT_EQ(same[i].trolley.travel_m, steps[i].trolley.travel_m);
    EXPECT_EQ(same[i].trolley.lift_m, steps[i].trolley.lift_m);
  }
}

TEST_F(DriveByTest, WhereNoPoseIsInReachItIsStuckAgainAndAgain) {
  world_.frame.workspace_base = Box(Vec3(4.0, -0.1, 0.1), Vec3(4.2, 0.1, 0.3));
  begin({});
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(until_it_rests().back().decision.action, Decision::Action::stuck) << "at any lift";
  }
}

TEST_F(DriveByTest, DoesNotDriveWithTheArmAmongThePlants) {
  begin(options(1, 0.5));
  Configuration across = Configuration::Zero(q_.size());
  across[0] = 1.57;
  Decision decision;
  for (int i = 0; i < 3; ++i) decision = planner_->decide(across, work_);  // it never gets away
  EXPECT_EQ(decision.action, Decision::Action::stuck);
}

TEST_F(DriveByTest, AtASingleStopItOnlyTakesItsPoses) {
  row_.clear();
  begin(options(2, 0.0));
  const auto steps = until_it_rests();
  EXPECT_TRUE(drives(steps).empty());
  EXPECT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps.back().decision.action, Decision::Action::done);
}

}  // namespace
}  // namespace canopeer
