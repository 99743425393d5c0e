#include "canopeer/robot/corner_rounding.h"

#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/motion_planner.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/straight_timing.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr TrolleyState kTrolley{1.0, 0.3};

class CornerRounding : public ::testing::Test {
 protected:
  CornerRounding() { checker_.set_map(&field_); }

  /// Free lines through so many waypoints, as a planner makes them.
  std::vector<Configuration> free_lines(std::size_t count) {
    while (true) {
      std::vector<Configuration> path = {random_configuration(random_, robot_)};
      if (!checker_.state_free(path.front())) continue;
      for (int attempt = 0; attempt < 200 && path.size() < count; ++attempt) {
        Configuration next = path.back();
        for (double& joint : next) joint += random_.uniform(-0.8, 0.8);
        if (checker_.edge_free(path.back(), next)) path.push_back(next);
      }
      if (path.size() == count) return path;
    }
  }

  Rng random_{19};
  const RobotModel& robot_ = shipped_robot();
  VoxelMap map_ = random_leaves(random_, robot_, kTrolley, 60);
  DistanceField field_ = field_around(map_, robot_, kTrolley);
  CollisionChecker checker_{robot_, kTrolley};
  ExactChecker exact_{robot_};
};

TEST_F(CornerRounding, NothingIsTouchedOnARoundedPath) {
  int states = 0;
  int rounded = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const JointPath path = round_corners(free_lines(4), robot_.limits(), checker_, states);
    if (path.deviations.empty()) continue;
    ++rounded;
    for (const Configuration& q : points_along(path, 0.01))
      ASSERT_FALSE(exact_.check(q, kTrolley, &map_).any()) << "trial " << trial;
  }
  EXPECT_GT(rounded, 20);
  EXPECT_GT(states, 0);
}

TEST_F(CornerRounding, AnArcThroughAVoxelIsNotTaken) {
  // A corner whose widest arc leads the camera over a voxel beside it.
  const Configuration corner = robot_.home("side_1");
  Configuration before = corner;
  before[0] -= 0.8;
  Configuration after = corner;
  after[1] -= 0.5;
  const CollisionChecker empty(robot_, kTrolley);
  const std::vector<Configuration> waypoints = {before, corner, after};
  int states = 0;
  const JointPath wide = round_corners(waypoints, robot_.limits(), empty, states);
  ASSERT_FALSE(wide.deviations.empty());
  const PathMotion motion(wide, robot_.limits());
  const Configuration middle = motion.at(0.5 * motion.duration_s());

  VoxelMap map;
  const Vec3 p = robot_.T_world_base(kTrolley) * robot_.T_base_camera(middle).translation();
  map.set_occupancy_log_odds(voxel_at(p, map.resolution_m()), 2.0);
  const DistanceField field = field_around(map, robot_, kTrolley);
  CollisionChecker checker(robot_, kTrolley);
  checker.set_map(&field);
  const JointPath narrow = round_corners(waypoints, robot_.limits(), checker, states);
  if (narrow.deviations.empty()) return;
  EXPECT_LT(narrow.deviations[1], wide.deviations[1]);
  for (const Configuration& q : points_along(narrow))
    ASSERT_FALSE(exact_.check(q, kTrolley, &map).any());
}

TEST_F(CornerRounding, IsFasterThanStoppingKeepsTheLimitsAndPassesWithinTheDeviation) {
  double stopping_s = 0.0;
  double rounded_s = 0.0;
  int states = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<Configuration> lines = free_lines(5);
    const JointPath path = round_corners(lines, robot_.limits(), checker_, states);
    stopping_s += motion_time(JointPath{lines}, robot_.limits());
    rounded_s += motion_time(path, robot_.limits());
    const PathMotion motion(path, robot_.limits());
    EXPECT_NEAR(motion.duration_s(), motion_time(path, robot_.limits()), 1e-6);
    for (double t = 0.0; t < motion.duration_s(); t += 0.01) {
      const Configuration v = motion.velocity_at(t);
      const Configuration a = motion.acceleration_at(t);
      ASSERT_TRUE((v.array().abs() <= robot_.limits().velocity.array() * (1.0 + 1e-9)).all());
      ASSERT_TRUE((a.array().abs() <= robot_.limits().acceleration.array() * (1.0 + 1e-9)).all());
      ASSERT_TRUE(robot_.within_limits(motion.at(t)));
    }
    if (path.deviations.empty()) continue;
    for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
      double nearest = 1e9;
      for (const Configuration& q : points_along(path, 0.001))
        nearest = std::min(nearest, (q - lines[i]).norm());
      EXPECT_LE(nearest, path.deviations[i] + 1e-4);
    }
  }
  EXPECT_LT(rounded_s, 0.95 * stopping_s);
}

TEST_F(CornerRounding, LeavesASingleLineAlone) {
  int states = 0;
  const std::vector<Configuration> line = {robot_.home("side_1"), robot_.home("side_2")};
  const JointPath path = round_corners(line, robot_.limits(), checker_, states);
  EXPECT_TRUE(path.deviations.empty());
  EXPECT_EQ(states, 0);
  EXPECT_EQ(points_along(path), line);
  EXPECT_EQ(motion_time(path, robot_.limits()), motion_time(line[0], line[1], robot_.limits()));
}

}  // namespace
}  // namespace canopeer
