// Arms whose joints turn without end: a turn is a turn for distances, inverse kinematics, plans,
// graphs and missions. The twin that they are held against has the same joints with ±2π.

#include <algorithm>
#include <limits>
#include <numbers>

#include "../../robot/robot_fixture.h"
#include "canopeer/mission/mission.h"
#include "canopeer/planner/registry.h"
#include "canopeer/robot/motion_planner.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/robot/robot_survey.h"
#include "canopeer/robot/straight_timing.h"
#include "canopeer/sim/simulation.h"
#include "canopeer/viewgraph/view_graph.h"
#include "small_arm.h"
#include "support/first_stop.h"

namespace canopeer {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr TrolleyState kTrolley{1.0, 0.0};

/// The shipped arm with other limits in all its joints.
RobotModel shipped_with(double limit) {
  RobotDescription description = shipped_robot().description();
  const RobotSetup& setup = shipped_robot().setup();
  for (Joint& joint : description.joints) {
    if (std::count(setup.arm_joints.begin(), setup.arm_joints.end(), joint.name) == 0) continue;
    joint.lower = -limit;
    joint.upper = limit;
  }
  auto made = RobotModel::make(std::move(description), setup);
  EXPECT_TRUE(made.has_value()) << made.error().message;
  return *made;
}

const RobotModel& endless_robot() {
  static const RobotModel robot = shipped_with(kInfinity);
  return robot;
}
const RobotModel& twin() {
  static const RobotModel robot = shipped_with(2.0 * kPi);
  return robot;
}

double farthest(const Configuration& a, const Configuration& b) {
  return (a - b).lpNorm<Eigen::Infinity>();
}

Configuration turned(Configuration q, Rng& random) {
  for (double& joint : q) joint += 2.0 * kPi * static_cast<double>(random.index(7)) - 6.0 * kPi;
  return q;
}

TEST(EndlessArm, ViewsLieWithinHalfATurnOfTheReferenceAndAreThoseOfTheTwin) {
  const RobotModel& robot = endless_robot();
  for (const bool numeric : {false, true}) {
    const auto ik = numeric ? ArmIk::make_numeric(robot) : ArmIk::make(robot);
    const auto other = numeric ? ArmIk::make_numeric(twin()) : ArmIk::make(twin());
    ASSERT_TRUE(ik && other);
    EXPECT_EQ(ik->kind(), numeric ? IkKind::kNumeric : IkKind::kUrLike);
    Rng random(2);
    std::vector<Configuration> found;
    std::vector<Configuration> of_twin;
    int seen = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const Pose T = robot.T_base_camera(random_configuration(random, robot));
      const Vec3 target = T * Vec3(0, 0, 0.4);
      const Configuration reference = turned(random_configuration(random, robot), random);
      ik->solve_view(T.translation(), target, reference, found);
      other->solve_view(T.translation(), target, robot.home("side_1"), of_twin);
      seen += found.empty() ? 0 : 1;
      if (!numeric) {
        EXPECT_GE(found.size(), of_twin.size());
      }
      for (const Configuration& q : found) {
        EXPECT_LE(farthest(q, reference), kPi + 1e-9);
        const Pose reached = robot.T_base_camera(q);
        EXPECT_LT((reached.translation() - T.translation()).norm(), 1e-6);
        EXPECT_LT((reached.linear().col(2) - T.linear().col(2)).norm(), 1e-6);
      }
      // Two branches are two places.
      for (std::size_t i = 0; numeric && i < found.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_GT(farthest(robot.endless().nearest(found[j], found[i]), found[i]), 0.1);
      }
    }
    EXPECT_GT(seen, 36);
  }
}

TEST(EndlessArm, ReachesNoLessThanTheTwin) {
  for (const int side : {1, 2}) {
    const ReachSurvey endless =
        survey_reach(endless_robot(), *ArmIk::make(endless_robot()), side, 200, 1);
    const ReachSurvey limited = survey_reach(twin(), *ArmIk::make(twin()), side, 200, 1);
    EXPECT_EQ(endless.views, limited.views);
    EXPECT_GE(endless.reached, limited.reached);
    EXPECT_GE(endless.free, limited.free);
  }
}

/// Leaves around both arms.
struct Leaves {
  explicit Leaves(int count) : map(random_leaves(random, twin(), kTrolley, count)) {
    loose.set_map(&field);
    limited.set_map(&field);
  }
  Configuration free_state() {
    while (true) {
      const Configuration q = random_configuration(random, endless_robot());
      if (loose.state_free(q)) return q;
    }
  }
  Rng random{5};
  VoxelMap map;
  DistanceField field = field_around(map, twin(), kTrolley);
  CollisionChecker loose{endless_robot(), kTrolley};
  CollisionChecker limited{twin(), kTrolley};
};

TEST(EndlessArm, AMotionThroughTheSeamIsTheShortOneAndThatOfTheTwin) {
  Leaves leaves(20);
  int through_the_seam = 0;
  int free = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Configuration a = random_configuration(leaves.random, endless_robot());
    const Configuration b = random_configuration(leaves.random, endless_robot());
    const Configuration near = endless_robot().endless().nearest(b, a);
    through_the_seam += farthest(near, b) > 1.0 ? 1 : 0;
    int states = 0;
    int states_of_twin = 0;
    const bool passed = leaves.loose.edge_free(a, near, &states);
    EXPECT_EQ(passed, leaves.limited.edge_free(a, near, &states_of_twin));
    EXPECT_EQ(states, states_of_twin);
    free += passed ? 1 : 0;
    EXPECT_EQ(motion_time(a, near, endless_robot().limits()),
              motion_time(a, near, twin().limits()));
    EXPECT_LE(motion_time(a, near, endless_robot().limits()),
              motion_time(a, b, endless_robot().limits()) + 1e-12);
    const PathMotion motion(std::vector{a, near}, endless_robot().limits());
    EXPECT_EQ(motion.duration_s(), PathMotion(std::vector{a, near}, twin().limits()).duration_s());
    Configuration last = motion.at(0.0);
    for (int k = 1; k <= 50; ++k) {
      const Configuration next = motion.at(motion.duration_s() * k / 50.0);
      EXPECT_LT(farthest(next, last), 0.3);
      last = next;
    }
  }
  EXPECT_GT(through_the_seam, 100);
  EXPECT_GT(free, 5);
}

TEST(EndlessArm, PlansEndAtTheGoalByFreeMotionsOfNoMoreThanHalfATurn) {
  Leaves leaves(40);
  const MotionPlanner planner(endless_robot());
  int found = 0;
  int bent = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Configuration start = turned(leaves.free_state(), leaves.random);
    const Configuration goal = leaves.free_state();
    const auto path = planner.plan(start, goal, leaves.loose, 7);
    if (!path) continue;
    ++found;
    bent += path->size() > 2 ? 1 : 0;
    EXPECT_EQ(path->front(), start);
    EXPECT_NEAR(endless_robot().endless().distance(path->back(), goal), 0.0, 1e-9);
    for (std::size_t i = 1; i < path->size(); ++i) {
      EXPECT_LE(farthest((*path)[i], (*path)[i - 1]), kPi + 1e-9);
      EXPECT_TRUE(leaves.loose.edge_free((*path)[i - 1], (*path)[i]));
    }
    EXPECT_EQ(planner.plan(start, goal, leaves.loose, 7), path);
  }
  EXPECT_GT(found, 8);
  EXPECT_GT(bent, 2);
}

/// The waist turns without end, all else hardly; a post stands behind the arm.
RobotModel arm_before_a_post() {
  test::SmallArm arm;
  arm.replace("name='j1' type='revolute'", "name='j1' type='continuous'");
  arm.replace("<axis xyz='0 0 1'/><limit lower='-2.5' upper='2.5'", "<axis xyz='0 0 1'/><limit");
  for (int i = 0; i < 5; ++i) arm.replace("lower='-2.5' upper='2.5'", "lower='-0.02' upper='0.02'");
  arm.replace("[1.5, -0.6, 1.2, 0.0, 0.3, 0.0]", "[0, 0, 0, 0, 0, 0]");
  arm.add(
      "<link name='post'><collision><origin xyz='-0.35 0 0.5'/><geometry><box size='0.06 0.06 "
      "1'/></geometry></collision></link>\n"
      "<joint name='foot' type='fixed'><parent link='base'/><child link='post'/></joint>\n");
  return arm.model();
}

TEST(EndlessArm, GoesTheLongWayRoundWhereTheShortOneIsBlocked) {
  RobotModel robot = arm_before_a_post();
  RobotDescription description = robot.description();
  for (const auto& [a, b] :
       {std::pair("waist", "upper"), std::pair("upper", "fore"), std::pair("fore", "roll"),
        std::pair("roll", "bend"), std::pair("bend", "tool")})
    description.disabled_pairs.emplace_back(a, b);
  robot = *RobotModel::make(description, robot.setup());
  const CollisionChecker checker(robot, {});
  for (const double turns : {0.0, 2.0 * kPi, -4.0 * kPi}) {
    Configuration start = Configuration::Zero(6);
    Configuration goal = start;
    start[0] = 2.5 + turns;
    goal[0] = -2.5;
    ASSERT_TRUE(checker.state_free(start) && checker.state_free(goal));
    EXPECT_FALSE(checker.edge_free(start, robot.endless().nearest(goal, start)));
    const auto path = MotionPlanner(robot).plan(start, goal, checker, 1);
    ASSERT_TRUE(path);
    EXPECT_NEAR(path->back()[0], -2.5 + turns, 1e-9);
    for (std::size_t i = 1; i < path->size(); ++i)
      EXPECT_TRUE(checker.edge_free((*path)[i - 1], (*path)[i]));
  }
}

TEST(EndlessArm, HasNoFewerNeighboursInTheGraph) {
  ViewGraph around;
  ViewGraph straight;
  around.set_endless(endless_robot().endless());
  Rng random(8);
  for (int i = 0; i < 200; ++i) {
    ViewPose view;
    view.q = random_configuration(random, endless_robot());
    around.add(view);
    straight.add(view);
  }
  int more = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Configuration q = random_configuration(random, endless_robot());
    const auto near = around.nearest(turned(q, random), 200, 6.0, NodeId{200});
    const auto fewer = straight.nearest(q, 200, 6.0, NodeId{200});
    more += near.size() > fewer.size() ? 1 : 0;
    for (const auto& n : fewer) {
      EXPECT_TRUE(std::any_of(near.begin(), near.end(),
                              [&](const auto& other) { return other.id == n.id; }));
    }
    for (const auto& n : near)
      EXPECT_NEAR(n.distance_rad, endless_robot().endless().distance(q, around.node(n.id).view.q),
                  1e-9);
  }
  EXPECT_GT(more, 30);
}

/// An arm that counts its turns anew after each motion, as some drives do.
class ForgetfulArm : public Arm {
 public:
  explicit ForgetfulArm(Arm& arm) : arm_(arm) {}
  Configuration configuration() const override {
    Configuration q = arm_.configuration();
    for (double& joint : q) joint -= 2.0 * kPi * std::round(joint / (2.0 * kPi));
    return q;
  }
  Expected<double> start(const JointPath& path) override {
    EXPECT_LT(farthest(path.waypoints.front(), configuration()), 1e-9);
    for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
      const double longest = farthest(path.waypoints[i], path.waypoints[i - 1]);
      EXPECT_LE(longest, kPi + 1e-9);
      motions += 1;
      through_the_seam += path.waypoints[i].lpNorm<Eigen::Infinity>() > kPi + 1e-6 ? 1 : 0;
    }
    return arm_.start(path);
  }
  Expected<MotionOutcome> finish() override {
    auto outcome = arm_.finish();
    if (outcome) {
      outcome->q = configuration();
      contacts += outcome->collision ? 1 : 0;
    }
    return outcome;
  }
  int motions = 0;
  int through_the_seam = 0;
  int contacts = 0;

 private:
  Arm& arm_;
};

class EndlessMission : public ::testing::TestWithParam<const char*> {};

TEST_P(EndlessMission, GoesByShortWaysAndTouchesNothing) {
  RobotSetup setup = endless_robot().setup();
  // Homes near ±π, whole turns apart in the file: views lie on both sides of the seam.
  for (auto& [name, q] : setup.home) q[5] += kPi - 0.1;
  setup.home["side_1"][0] += 2.0 * kPi;
  setup.home["side_1"][3] -= 4.0 * kPi;
  const RobotModel robot = *RobotModel::make(endless_robot().description(), setup);
  const test::FirstStop stop(robot);
  Simulation simulation(robot, stop.scene, robot.home("side_1"), kTrolley, {});
  ForgetfulArm arm(*simulation.ports().arm);
  Ports ports = simulation.ports();
  ports.arm = &arm;
  MissionOptions options;
  options.planner = GetParam();
  options.segments = {{kTrolley, 1, "1"}, {kTrolley, 2, "2"}};
  options.segment_time_s = 3.0;
  options.costs[Work::candidate] = 1e-4;
  const RobotKit kit{robot, stop.ik, simulation.judge().checker()};
  Mission mission(kit, ports, options, Registries::built_in());
  simulation.watch_map(&mission.map());
  const auto outcome = mission.run();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_GT(arm.motions, 3);
  EXPECT_GT(arm.through_the_seam, 0);
  EXPECT_EQ(arm.contacts, 0);
}

INSTANTIATE_TEST_SUITE_P(Planners, EndlessMission, ::testing::Values("vmp", "random"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace canopeer
