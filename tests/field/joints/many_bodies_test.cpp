// Joints that follow others, in the arm and beside it, together with more links than clearances
// are kept for: FCL judges what the fast check says.

#include <set>

#include "canopeer/base/rng.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::joint_line;
using test::SmallArm;

std::string link_with_box(const std::string& name, double x, double y, double z,
                          const std::string& size = "0.02 0.02 0.02") {
  return "<link name='" + name + "'><collision><origin xyz='" + std::to_string(x) + " " +
         std::to_string(y) + " " + std::to_string(z) + "'/><geometry><box size='" + size +
         "'/></geometry></collision></link>\n";
}

std::string follows(const std::string& joint, double multiplier, double offset = 0.0) {
  return "<mimic joint='" + joint + "' multiplier='" + std::to_string(multiplier) + "' offset='" +
         std::to_string(offset) + "'/>";
}

/// A row of links fixed one to the other beside `parent`, a box in each.
std::string row_on(const std::string& parent, int count) {
  std::string urdf;
  std::string from = parent;
  for (int i = 0; i < count; ++i) {
    const std::string name = parent + "_part" + std::to_string(i);
    urdf += link_with_box(name, 0.0, 0.03, 0.0) + "<joint name='" + name +
            "_fix' type='fixed'><parent link='" + from + "'/><child link='" + name +
            "'/><origin xyz='0.002 0.006 0.001' rpy='0.03 0 0.02'/>" + "</joint>\n";
    from = name;
  }
  return urdf;
}

/// A second elbow in the forearm folds back half as far as the first; a rod beside the arm swings
/// with the shoulder. `parts` links more stand on the second elbow, twice as many on the tool.
RobotModel arm_with_parts(int parts) {
  SmallArm arm;
  arm.replace("<parent link='fore'/><child link='roll'/>",
              "<parent link='knee'/><child link='roll'/>");
  arm.add(link_with_box("knee", 0.1, 0.0, 0.0, "0.15 0.03 0.03") +
          joint_line("fold", "continuous", "fore", "knee", "0.32 0 0", "0 1 0",
                     follows("j3", -0.5, 0.2)) +
          link_with_box("rod", 0.0, 0.0, 0.3, "0.03 0.03 0.6") +
          joint_line("swing", "continuous", "base", "rod", "0.15 0.12 0.2", "0 1 0",
                     follows("j2", -2.0, 0.3)) +
          row_on("knee", parts) + row_on("tool", 2 * parts));
  return arm.model();
}

Configuration draw_place(Rng& random, const RobotModel& robot) {
  Configuration q(robot.dof());
  for (int i = 0; i < q.size(); ++i)
    q[i] = random.uniform(robot.span().lower[i], robot.span().upper[i]);
  return q;
}

DistanceField field_of(const VoxelMap& map) {
  DistanceFieldOptions options;
  options.world = Box(Vec3::Constant(-1.6), Vec3::Constant(1.6));
  DistanceField field(options, map.resolution_m());
  field.rebuild(map);
  return field;
}

/// What the fast check calls free is free on the exact shapes: states, and edges all along.
void judge(const RobotModel& robot, int states, int edges, std::uint64_t seed) {
  Rng random(seed);
  VoxelMap map;
  for (int i = 0; i < 30; ++i) {
    const Vec3 p{random.uniform(-0.8, 0.8), random.uniform(0.3, 1.0), random.uniform(0.1, 1.1)};
    map.set_occupancy_log_odds(voxel_at(p, map.resolution_m()), 2.0F);
  }
  const DistanceField field = field_of(map);
  CollisionChecker fast(robot, {});
  fast.set_map(&field);
  const ExactChecker exact(robot);
  int fast_free = 0;
  int judge_free = 0;
  for (int trial = 0; trial < states; ++trial) {
    const Configuration q = draw_place(random, robot);
    const bool free = fast.state_free(q);
    ASSERT_EQ(free, fast.edge_free(q, q)) << q.transpose();
    const ContactReport report = exact.check(q, {}, &map);
    ASSERT_FALSE(free && report.any()) << report.pair << " at " << q.transpose();
    fast_free += free ? 1 : 0;
    judge_free += report.any() ? 0 : 1;
  }
  EXPECT_GT(judge_free, states / 20);
  EXPECT_GT(fast_free, judge_free / 2);

  int free_edges = 0;
  int blocked_inside = 0;  // between two free ends
  for (int trial = 0; trial < 8000; ++trial) {
    if (free_edges >= edges && blocked_inside > 0) break;
    const Configuration a = draw_place(random, robot);
    Configuration b = a;
    for (int i = 0; i < b.size(); ++i)
      b[i] = std::clamp(a[i] + random.uniform(-1.2, 1.2), robot.limits().lower[i],
                        robot.limits().upper[i]);
    if (!fast.state_free(a) || !fast.state_free(b)) continue;
    if (!fast.edge_free(a, b)) {
      ++blocked_inside;
      continue;
    }
    ++free_edges;
    for (int step = 0; step <= 40; ++step) {
      const Configuration q = a + step / 40.0 * (b - a);
      const ContactReport report = exact.check(q, {}, &map);
      ASSERT_FALSE(report.any()) << report.pair << " at " << q.transpose();
    }
  }
  EXPECT_GE(free_edges, edges);
  EXPECT_GT(blocked_inside, 0);
}

TEST(FieldManyBodies, AreWhatNothingMovesAgainstEachOther) {
  const RobotModel robot = arm_with_parts(10);
  EXPECT_EQ(robot.bodies(), 8);  // of six arm joints and two that follow
  std::set<int> bodies;
  for (const char* name : {"waist", "upper", "fore", "knee", "roll", "bend", "tool", "rod"})
    bodies.insert(robot.body_of(robot.link_index(name)));
  EXPECT_EQ(bodies.size(), 8U);
  EXPECT_EQ(robot.body_of(robot.link_index("base")), -1);
  EXPECT_EQ(robot.body_of(robot.link_index("knee_part9")), robot.body_of(robot.link_index("knee")));
  EXPECT_EQ(robot.body_of(robot.link_index("camera")), robot.body_of(robot.link_index("tool")));
}

TEST(FieldManyBodies, StandWhereTheirLinksDo) {
  const RobotModel robot = arm_with_parts(10);
  Rng random(1);
  std::vector<Pose> T_world_body(static_cast<std::size_t>(robot.bodies()));
  std::vector<Pose> T_world_link;
  for (int trial = 0; trial < 100; ++trial) {
    const Configuration q = draw_place(random, robot);
    robot.link_poses(q, {}, T_world_link);
    robot.body_poses(q, robot.T_world_base({}), T_world_body.data());
    for (const int link : robot.moving_links()) {
      const Pose T =
          T_world_body[static_cast<std::size_t>(robot.body_of(link))] * robot.T_body_link(link);
      ASSERT_TRUE(T.isApprox(T_world_link[static_cast<std::size_t>(link)], 1e-12))
          << robot.links()[static_cast<std::size_t>(link)].name;
    }
  }
}

TEST(FieldManyBodies, AreFreeWhereTheJudgeSaysSoWithAClearanceForEachLink) {
  judge(arm_with_parts(7), 2000, 150, 2);
}

TEST(FieldManyBodies, AreFreeWhereTheJudgeSaysSoWithAClearanceForEachBody) {
  judge(arm_with_parts(20), 2000, 150, 3);
}

/// A hand of 0.3 m on a clock over the forearm, which the last joint drives eight times as fast. At
/// 0 it points away from the forearm. The joint itself moves nothing but the tool's parts. A peg on
/// the forearm can stand in the hand's way: far out, and not where halving the
/// way some times leads to.
RobotModel arm_with_clock(bool peg) {
  SmallArm arm;
  if (peg) {
    arm.add(
        link_with_box("peg", 0.2186, -0.0364, 0.08, "0.02 0.02 0.04") +
        "<joint name='peg_fix' type='fixed'><parent link='fore'/><child link='peg'/></joint>\n");
  }
  arm.add(link_with_box("hand", 0.18, 0.0, 0.0, "0.3 0.02 0.02") +
          joint_line("clock", "continuous", "base", "hand", "0.1 0.25 0.78", "0 0 1",
                     follows("j6", 8.0, 1.5708)) +
          row_on("tool", 40));
  return arm.model();
}

/// At zero, and with the last joint turned so that the hand goes round by `turns`.
struct HandMotion {
  Configuration a = Configuration::Zero(6);
  Configuration b = Configuration::Zero(6);
  explicit HandMotion(double turns) { b[5] = turns * 6.2831853 / 8.0; }
};

TEST(FieldManyBodies, OneThatMeetsALinkThatStandsStillBetweenTwoFreeEndsIsSeen) {
  const RobotModel robot = arm_with_clock(true);
  const CollisionChecker checker(robot, {});
  const HandMotion whole(1.0);
  const HandMotion quarter(0.25);
  EXPECT_TRUE(checker.state_free(whole.a));
  EXPECT_TRUE(checker.state_free(whole.b));
  EXPECT_TRUE(checker.edge_free(quarter.a, quarter.b));
  EXPECT_FALSE(checker.edge_free(whole.a, whole.b));
}

TEST(FieldManyBodies, OneThatMeetsALeafBetweenTwoFreeEndsIsSeen) {
  const RobotModel robot = arm_with_clock(false);
  VoxelMap map;
  map.set_occupancy_log_odds(voxel_at(Vec3(0.2186, -0.0364, 0.78), map.resolution_m()), 2.0F);
  const DistanceField field = field_of(map);
  CollisionChecker checker(robot, {});
  const HandMotion whole(1.0);
  const HandMotion quarter(0.25);
  EXPECT_TRUE(checker.edge_free(whole.a, whole.b));
  checker.set_map(&field);
  EXPECT_TRUE(checker.state_free(whole.a));
  EXPECT_TRUE(checker.state_free(whole.b));
  EXPECT_TRUE(checker.edge_free(quarter.a, quarter.b));
  EXPECT_FALSE(checker.edge_free(whole.a, whole.b));
}

TEST(FieldManyBodies, AFollowerMayStandBetweenTheBaseAndTheFirstArmJoint) {
  SmallArm arm;
  arm.replace("<parent link='base'/><child link='waist'/>",
              "<parent link='plate'/><child link='waist'/>");
  arm.add(
      link_with_box("plate", 0.0, 0.0, 0.0) +
      joint_line("turn", "continuous", "base", "plate", "0 0 0.05", "0 0 1", follows("j6", 0.5)) +
      row_on("tool", 30));
  judge(arm.model(), 1000, 60, 4);
}

TEST(FieldManyBodies, AsManyAsMayFollowAreTaken) {
  SmallArm arm;
  std::string fingers;
  for (int i = 0; i < ArmChain::kMaxFollowers; ++i) {
    const std::string name = "finger" + std::to_string(i);
    fingers += link_with_box(name, 0.03, 0.0, 0.0, "0.01 0.01 0.01") +
               joint_line(name + "_joint", "continuous", i % 2 == 0 ? "fore" : "tool", name,
                          "0.1 " + std::to_string(0.06 + 0.04 * (i / 2)) + " 0.05", "0 1 0",
                          follows(i % 3 == 0 ? "j2" : "j5", 0.45 - 0.1 * (i % 5), 0.1 * i));
  }
  arm.add(fingers + row_on("tool", 20));
  const RobotModel robot = arm.model();
  EXPECT_EQ(robot.bodies(), 6 + ArmChain::kMaxFollowers);
  judge(robot, 1000, 60, 5);
}

}  // namespace
}  // namespace canopeer
