#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

constexpr TrolleyState kTrolley{1.0, 0.3};

class Collision : public ::testing::Test {
 protected:
  Collision() { fast_.set_map(&field_); }

  bool exact_free(const Configuration& q) const { return !exact_.check(q, kTrolley, &map_).any(); }

  Rng random_{11};
  const RobotModel& robot_ = shipped_robot();
  VoxelMap map_ = random_leaves(random_, robot_, kTrolley, 60);
  DistanceField field_ = field_around(map_, robot_, kTrolley);
  CollisionChecker fast_{robot_, kTrolley};
  ExactChecker exact_{robot_};
};

TEST_F(Collision, HomeStatesAreFree) {
  for (const double lift : {0.0, 0.7, 2.2}) {
    const CollisionChecker fast(robot_, {0.0, lift});
    for (const char* name : {"side_1", "side_2"}) {
      EXPECT_TRUE(fast.state_free(robot_.home(name))) << name;
      EXPECT_FALSE(exact_.check(robot_.home(name), {0.0, lift}).any()) << name;
    }
  }
}

TEST_F(Collision, AStateCalledFreeIsFreeForTheExactJudge) {
  int fast_free = 0;
  int judge_free = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const Configuration q = random_configuration(random_, robot_);
    const bool fast = fast_.state_free(q);
    const ContactReport report = exact_.check(q, kTrolley, &map_);
    fast_free += fast;
    judge_free += !report.any();
    EXPECT_FALSE(fast && report.any()) << report.pair << " at " << q.transpose();
  }
  // Both kinds occur, and the price of being conservative is small.
  EXPECT_GT(judge_free, 1000);
  EXPECT_LT(judge_free, 5000);
  EXPECT_GT(fast_free, judge_free * 0.75);
}

TEST_F(Collision, TheQuickAnswerIsThatOfTheClearancesAtTheEndOfTheFieldToo) {
  DistanceFieldOptions options;
  const Vec3 base = robot_.T_world_base(kTrolley).translation();
  options.world = Box(base - Vec3::Constant(0.45), base + Vec3::Constant(0.45));
  DistanceField small(options, map_.resolution_m());
  small.rebuild(map_);
  CollisionChecker checker(robot_, kTrolley);
  checker.set_map(&small);
  for (int trial = 0; trial < 20000; ++trial) {
    const Configuration q = random_configuration(random_, robot_);
    ASSERT_EQ(checker.state_free(q), checker.edge_free(q, q)) << q.transpose();
  }
}

TEST_F(Collision, TheQuickAnswerIsThatOfTheClearances) {
  // An edge of no length is checked by its clearances.
  CollisionOptions bare;
  bare.map_padding_m = bare.self_padding_m = 0.0;
  CollisionChecker unpadded(robot_, kTrolley, bare);
  unpadded.set_map(&field_);
  int free = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Configuration q = random_configuration(random_, robot_);
    if (trial % 2 == 0) {  // in front of the plants
      q = robot_.home("side_1");
      for (double& joint : q) joint += random_.uniform(-0.9, 0.9);
    }
    for (const CollisionChecker* checker : {&fast_, &unpadded}) {
      const bool quick = checker->state_free(q);
      ASSERT_EQ(quick, checker->edge_free(q, q)) << q.transpose();
      free += quick ? 1 : 0;
    }
  }
  EXPECT_GT(free, 4000);
  EXPECT_LT(free, 36000);
}

TEST_F(Collision, AStateCalledFreeIsFreeForTheExactJudgeNearContactToo) {
  // From a free state towards a colliding one: the last state the fast check still accepts.
  int pairs = 0;
  while (pairs < 300) {
    const Configuration a = random_configuration(random_, robot_);
    const Configuration b = random_configuration(random_, robot_);
    if (!fast_.state_free(a) || fast_.state_free(b)) continue;
    ++pairs;
    double free = 0.0;
    double blocked = 1.0;
    while (blocked - free > 1e-9) {
      const double middle = (free + blocked) / 2.0;
      (fast_.state_free(a + middle * (b - a)) ? free : blocked) = middle;
    }
    EXPECT_TRUE(exact_free(a + free * (b - a)));
  }
}

TEST_F(Collision, AnEdgeCalledFreeIsFreeForTheExactJudgeAllAlong) {
  int accepted = 0;
  int rejected = 0;
  while (accepted < 60 || rejected < 60) {
    const Configuration a = random_configuration(random_, robot_);
    Configuration b = a;
    for (double& joint : b) joint += random_.uniform(-0.5, 0.5);
    if (!fast_.state_free(a) || !fast_.state_free(b)) continue;
    const bool free = fast_.edge_free(a, b);
    ++(free ? accepted : rejected);
    for (int step = 0; free && step <= 100; ++step)
      ASSERT_TRUE(exact_free(a + step / 100.0 * (b - a)));
  }
}

TEST_F(Collision, NoStateOnAFreeEdgeTouchesAnything) {
  // Between two states it looks at, the padding may be used up, but no more than that.
  CollisionOptions bare;
  bare.map_padding_m = bare.self_padding_m = 0.0;
  CollisionChecker unpadded(robot_, kTrolley, bare);
  unpadded.set_map(&field_);
  int edges = 0;
  while (edges < 100) {
    const Configuration a = random_configuration(random_, robot_);
    Configuration b = a;
    for (double& joint : b) joint += random_.uniform(-0.4, 0.4);
    int states = 0;
    if (!fast_.state_free(a) || !fast_.edge_free(a, b, &states)) continue;
    ++edges;
    EXPECT_GE(states, 2);
    for (int step = 0; step <= 200; ++step)
      ASSERT_TRUE(unpadded.state_free(a + step / 200.0 * (b - a)));
  }
}

TEST_F(Collision, ASingleVoxelInTheWayIsNotSteppedOver) {
  const Configuration& home = robot_.home("side_1");
  Configuration turned = home;
  turned[0] += 1.5;
  CollisionChecker fast(robot_, kTrolley);
  ASSERT_TRUE(fast.edge_free(home, turned));
  // Where the camera is half way.
  const Vec3 p =
      robot_.T_world_base(kTrolley) * robot_.T_base_camera((home + turned) / 2.0).translation();
  VoxelMap map;
  map.set_occupancy_log_odds(voxel_at(p, map.resolution_m()), 2.0);
  const DistanceField field = field_around(map, robot_, kTrolley);
  fast.set_map(&field);
  EXPECT_TRUE(fast.state_free(home));
  EXPECT_TRUE(fast.state_free(turned));
  EXPECT_FALSE(fast.edge_free(home, turned));
  EXPECT_TRUE(exact_.check((home + turned) / 2.0, kTrolley, &map).map);
}

TEST_F(Collision, AStartThatBecameBlockedCanBeLeft) {
  const Configuration& home = robot_.home("side_1");
  CollisionChecker fast(robot_, kTrolley);
  const Vec3 beside =
      robot_.T_world_base(kTrolley) * robot_.T_base_camera(home) * Vec3(0.0, 0.0, 0.01);
  VoxelMap map;
  map.set_occupancy_log_odds(voxel_at(beside, map.resolution_m()), 2.0);
  const DistanceField field = field_around(map, robot_, kTrolley);
  fast.set_map(&field);
  ASSERT_FALSE(fast.state_free(home));
  Configuration back = home;
  back[1] -= 0.3;  // sideways for the camera
  EXPECT_TRUE(fast.state_free(back));
  EXPECT_FALSE(fast.edge_free(home, back));
  EXPECT_TRUE(fast.escape_free(home, back));
  const Configuration turn = Configuration::Unit(home.size(), 0) * 0.6;
  const Configuration through = back + turn;  // over the voxel; the end is free
  const Configuration aside = back - turn;
  EXPECT_TRUE(fast.state_free(through));
  EXPECT_FALSE(fast.escape_free(home, through));
  EXPECT_TRUE(fast.escape_free(home, aside));
}

TEST_F(Collision, ManyObstaclesAreTouchedWhereOneOfThemIs) {
  const Vec3 base = robot_.T_world_base(kTrolley).translation();
  std::vector<TriangleMesh> all;
  std::vector<MeshObstacles> singly;
  for (int i = 0; i < 60; ++i) {
    Vec3 low = base;
    for (int k = 0; k < 3; ++k) low[k] += random_.uniform(-1.2, 1.2);
    const Vec3 size{random_.uniform(0.02, 0.4), random_.uniform(0.02, 0.4), 0.05};
    all.push_back(make_box(Box(low, low + size)));
    singly.emplace_back(std::vector<TriangleMesh>{all.back()});
  }
  const MeshObstacles together(all);
  int touched = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Configuration q = random_configuration(random_, robot_);
    const bool any = std::any_of(singly.begin(), singly.end(), [&](const MeshObstacles& one) {
      return exact_.touches(q, kTrolley, one);
    });
    EXPECT_EQ(exact_.touches(q, kTrolley, together), any) << q.transpose();
    touched += any ? 1 : 0;
  }
  EXPECT_GT(touched, 20);
  EXPECT_LT(touched, 380);
}

TEST_F(Collision, TheJudgeTellsSelfStructureMapAndPlantApart) {
  const Configuration& home = robot_.home("side_1");
  const Vec3 camera = robot_.T_world_base(kTrolley) * robot_.T_base_camera(home).translation();
  TriangleMesh beam = make_box(Box(camera - Vec3(0.01, 0.01, 2.0), camera + Vec3(0.01, 0.01, 2.0)));
  const ExactChecker in_structure(robot_, {beam});
  const ContactReport report = in_structure.check(home, kTrolley, nullptr);
  EXPECT_TRUE(report.structure);
  EXPECT_FALSE(report.self || report.map);
  EXPECT_NE(report.pair.find("structure"), std::string::npos);

  EXPECT_TRUE(exact_.touches(home, kTrolley, MeshObstacles({beam})));
  EXPECT_FALSE(exact_.touches(robot_.home("side_2"), {3.0, 0.3}, MeshObstacles({beam})));

  Configuration folded = home;
  folded[1] = 0.6;  // the arm into its platform
  EXPECT_TRUE(exact_.check(folded, kTrolley, nullptr).self);
}

}  // namespace
}  // namespace canopeer
