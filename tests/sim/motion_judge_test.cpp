#include "canopeer/sim/motion_judge.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "canopeer/map/fusion.h"
#include "canopeer/robot/corner_rounding.h"
#include "canopeer/scene/worlds.h"
#include "canopeer/sim/simulation.h"
#include "support/plain_judge.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

/// A stop of a world, seen from home and from some states beside it, and both judges.
struct Stop {
  explicit Stop(const WorldOptions& world)
      : scene(make_world(world, 1)), judge(robot, scene), plain(robot, scene, trolley) {
    Simulation simulation(robot, scene, home, trolley, {});
    const Ports ports = simulation.ports();
    Rng rng(4, "views of the stop");
    for (int i = 0; i < 6; ++i) {
      const Configuration q = around_home(rng, i == 0 ? 0.0 : 0.4);
      if (!ports.arm->start({{ports.arm->configuration(), q}})) continue;
      static_cast<void>(ports.arm->finish());
      fuse(map, *ports.camera->capture(), {}, {});
    }
  }

  [[nodiscard]] Configuration anywhere(Rng& rng) const {
    Configuration q(robot.dof());
    for (int i = 0; i < q.size(); ++i)
      q[i] = rng.uniform(robot.span().lower[i], robot.span().upper[i]);
    return q;
  }
  /// Where views are taken from: mostly free, near the plants.
  [[nodiscard]] Configuration around_home(Rng& rng, double spread) const {
    Configuration q = home;
    for (int i = 0; i < q.size(); ++i) q[i] += rng.uniform(-spread, spread);
    return q;
  }

  void expect_equal(const std::vector<Configuration>& waypoints, bool with_map = true) {
    const VoxelMap* known = with_map ? &map : nullptr;
    const Verdict expected = plain.judge(waypoints, known);
    const Verdict found = judge.judge(waypoints, trolley, known);
    EXPECT_EQ(found.collision, expected.collision);
    EXPECT_EQ(found.plant_contact, expected.plant_contact);
    ++judged;
    collisions += expected.collision ? 1 : 0;
    contacts += expected.plant_contact ? 1 : 0;
  }

  const RobotModel& robot = test::test_robot();
  TrolleyState trolley{1.0, 0.0};
  Configuration home = robot.home("side_1");
  Scene scene;
  MotionJudge judge;
  test::PlainJudge plain;
  VoxelMap map;
  int judged = 0;
  int collisions = 0;
  int contacts = 0;
};

class Judges : public ::testing::TestWithParam<const char*> {
 protected:
  static Stop& stop() {
    static Stop scenario(scenario_1_world());
    static Stop dense(dense_1_world());
    return std::string(GetParam()) == "dense_1" ? dense : scenario;
  }
  void SetUp() override { stop().judged = stop().collisions = stop().contacts = 0; }
};

TEST_P(Judges, SayOfAnyStateWhatThePlainOneSays) {
  Rng rng(1, "judged states");
  for (int i = 0; i < 1000; ++i) {
    stop().expect_equal({stop().anywhere(rng)});
    stop().expect_equal({stop().around_home(rng, 0.8)}, i % 4 != 0);
  }
  EXPECT_GT(stop().collisions, 50);
  EXPECT_GT(stop().contacts, 20);
  EXPECT_LT(stop().collisions, stop().judged - 50);
}

TEST_P(Judges, AgreeWhereTheArmJustTouchesSomething) {
  Rng rng(2, "judged states");
  const auto touches = [&](const Configuration& q) {
    const Verdict verdict = stop().plain.judge({q}, &stop().map);
    return verdict.collision || verdict.plant_contact;
  };
  int grazed = 0;
  for (int i = 0; i < 400 && grazed < 60; ++i) {
    Configuration free = stop().around_home(rng, 0.8);
    Configuration hit = stop().around_home(rng, 1.2);
    if (touches(free) || !touches(hit)) continue;
    for (int halves = 0; halves < 20; ++halves) {
      const Configuration middle = (free + hit) / 2.0;
      (touches(middle) ? hit : free) = middle;
      stop().expect_equal({middle});
    }
    ++grazed;
  }
  EXPECT_GE(grazed, 30);
}

TEST_P(Judges, AgreeOnWholeMotionsAndArcs) {
  Rng rng(3, "judged motions");
  for (int i = 0; i < 12; ++i) {
    const std::vector<Configuration> corners = {stop().home, stop().around_home(rng, 0.4),
                                                stop().around_home(rng, 0.4),
                                                stop().around_home(rng, 0.4)};
    stop().expect_equal(corners);
    stop().expect_equal(points_along({corners, {0.0, 0.2, 0.2, 0.0}}));
  }
}

TEST_P(Judges, CallFreeWhatTouchesNothing) {
  Rng rng(5, "free motions");
  const MotionJudge without_map(stop().robot, stop().scene);
  int free = 0;
  constexpr int kMotions = 80;
  for (int i = 0; i < kMotions; ++i) {
    std::vector<Configuration> waypoints;
    for (int k = 0; k < i % 4 + 1; ++k) waypoints.push_back(stop().around_home(rng, 0.3));
    const Verdict verdict = without_map.judge(waypoints, stop().trolley, nullptr);
    const bool expected = !verdict.collision && !verdict.plant_contact;
    EXPECT_EQ(without_map.free(waypoints, stop().trolley), expected);
    free += expected ? 1 : 0;
  }
  EXPECT_GT(free, 5);
  EXPECT_LT(free, kMotions - 5);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Judges, ::testing::Values("scenario_1", "dense_1"),
                         [](const auto& name) { return std::string(name.param); });

TEST(MotionJudge, HasNothingToSayOfNoMotion) {
  const Scene scene;
  const MotionJudge judge(test::test_robot(), scene);
  const Verdict verdict = judge.judge({}, {}, nullptr);
  EXPECT_FALSE(verdict.collision);
  EXPECT_FALSE(verdict.plant_contact);
  EXPECT_TRUE(judge.free({}, {}));
}

TEST(MotionJudge, SaysTheSameWithMoreStopsKept) {
  const Scene scene = make_world(dense_1_world(), 1);
  const RobotModel& robot = test::test_robot();
  const MotionJudge one(robot, scene);
  const MotionJudge three(robot, scene, 0.01, 3);
  Rng rng(4, "judged at stops");
  int touched = 0;
  for (int i = 0; i < 24; ++i) {
    const TrolleyState trolley{0.5 * static_cast<double>(rng.index(4)), 0.0};
    Configuration q = robot.home("side_1");
    for (int k = 0; k < q.size(); ++k) q[k] += rng.uniform(-0.7, 0.7);
    const Verdict a = one.judge({q}, trolley, nullptr);
    const Verdict b = three.judge({q}, trolley, nullptr);
    EXPECT_EQ(a.collision, b.collision);
    EXPECT_EQ(a.plant_contact, b.plant_contact);
    touched += a.collision || a.plant_contact ? 1 : 0;
  }
  EXPECT_GT(touched, 2);
  EXPECT_LT(touched, 22);
}

TEST(MotionJudge, LearnsWhatTheMapLearns) {
  const Scene scene;
  const RobotModel& robot = test::test_robot();
  const MotionJudge judge(robot, scene);
  const TrolleyState trolley{1.0, 0.0};
  const Configuration q = robot.home("side_1");
  VoxelMap map;
  EXPECT_FALSE(judge.judge({q}, trolley, &map).collision);
  const Vec3 camera = (robot.T_world_base(trolley) * robot.T_base_camera(q)).translation();
  map.set_occupancy_log_odds(voxel_at(camera, map.resolution_m()), 2.0);
  EXPECT_TRUE(judge.judge({q}, trolley, &map).collision);
  // Seen to be free after all: FCL decides.
  map.set_occupancy_log_odds(voxel_at(camera, map.resolution_m()), -2.0);
  EXPECT_FALSE(judge.judge({q}, trolley, &map).collision);
}

}  // namespace
}  // namespace canopeer
