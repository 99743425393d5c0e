// Arms of more links and shapes than anybody planned for: FCL judges what the fast check says.

#include "canopeer/base/rng.h"
#include "canopeer/config/urdf.h"
#include "canopeer/map/distance_field.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/robot_survey.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::input;

/// The small arm with `more` of URDF in it, and with `in_link6` in its last link.
RobotModel arm_with(const std::string& more, const std::string& in_link6 = "") {
  std::string urdf = *read_file(input("base_on_floor/robot.urdf"));
  const std::string last = "<link name=\"link6\">";
  urdf.insert(urdf.find(last) + last.size(), in_link6);
  urdf.insert(urdf.find("</robot>"), more);
  auto robot = parse_urdf(urdf, "many.urdf");
  if (!robot) throw std::runtime_error(robot.error().message);
  robot->neighbours_may_touch = true;
  for (Joint& joint : robot->joints) joint.acceleration_limit = 1.0;
  auto model =
      RobotModel::make(std::move(*robot), test::robot_of("base_on_floor/robot.yaml").setup());
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(*model);
}

std::string box_at(double x, double y, double z, double edge = 0.02) {
  const auto text = [](double value) { return std::to_string(value); };
  return "<collision><origin xyz='" + text(x) + " " + text(y) + " " + text(z) +
         "'/><geometry><box size='" + text(edge) + " " + text(edge) + " " + text(edge) +
         "'/></geometry></collision>";
}

/// `count` links fixed around `parent`, a box in each.
std::string parts_on(const std::string& parent, int count) {
  std::string urdf;
  for (int i = 0; i < count; ++i) {
    const std::string name = parent + "_part" + std::to_string(i);
    urdf += "<joint name='" + name + "_joint' type='fixed'><parent link='" + parent +
            "'/><child link='" + name + "'/></joint><link name='" + name + "'>" +
            box_at(0.0, 0.05 * (1 + i % 6), 0.03 * (i / 6) - 0.06) + "</link>";
  }
  return urdf;
}

Configuration draw(Rng& random, const RobotModel& robot) {
  Configuration q(robot.dof());
  for (int i = 0; i < q.size(); ++i)
    q[i] = random.uniform(robot.limits().lower[i], robot.limits().upper[i]);
  return q;
}

DistanceField field_of(const VoxelMap& map) {
  DistanceFieldOptions options;
  options.world = Box(Vec3::Constant(-1.5), Vec3::Constant(1.5));
  DistanceField field(options, map.resolution_m());
  field.rebuild(map);
  return field;
}

VoxelMap leaves(Rng& random, int count) {
  VoxelMap map;
  for (int i = 0; i < count; ++i) {
    const Vec3 p{random.uniform(-0.8, 0.8), random.uniform(0.3, 1.0), random.uniform(0.1, 1.1)};
    map.set_occupancy_log_odds(voxel_at(p, map.resolution_m()), 2.0F);
  }
  return map;
}

TEST(ManyLinks, AreFreeOnlyWhereTheExactJudgeSaysSo) {
  // 60 links that stand on the wrist and 12 on the elbow, on top of the arm's own six.
  const RobotModel robot = arm_with(parts_on("link6", 60) + parts_on("link3", 12));
  EXPECT_EQ(robot.moving_links().size(), 60U + 12U + 7U);
  Rng random(3);
  const VoxelMap map = leaves(random, 40);
  const DistanceField field = field_of(map);
  CollisionChecker fast(robot, {});
  fast.set_map(&field);
  const ExactChecker exact(robot);
  int fast_free = 0;
  int judge_free = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Configuration q = draw(random, robot);
    const bool free = fast.state_free(q);
    ASSERT_EQ(free, fast.edge_free(q, q)) << q.transpose();
    const ContactReport report = exact.check(q, {}, &map);
    ASSERT_FALSE(free && report.any()) << report.pair << " at " << q.transpose();
    fast_free += free ? 1 : 0;
    judge_free += report.any() ? 0 : 1;
  }
  EXPECT_GT(judge_free, 40);
  EXPECT_GT(fast_free, judge_free / 2);
}

TEST(ManyLinks, OfAFreeEdgeAreFreeAllAlong) {
  const RobotModel robot = arm_with(parts_on("link6", 60));
  const CollisionChecker fast(robot, {});
  const ExactChecker exact(robot);
  Rng random(4);
  int edges = 0;
  for (int trial = 0; trial < 2000 && edges < 15; ++trial) {
    const Configuration a = draw(random, robot);
    Configuration b = a;
    for (double& joint : b) joint += random.uniform(-0.4, 0.4);
    if (!fast.state_free(a) || !fast.edge_free(a, b)) continue;
    ++edges;
    for (int step = 0; step <= 20; ++step)
      ASSERT_FALSE(exact.check(a + step / 20.0 * (b - a), {}).any());
  }
  EXPECT_EQ(edges, 15);
}

TEST(ManyLinks, ThatAreOnePieceGiveTheAnswersOfOneLink) {
  std::string shapes;
  for (int i = 0; i < 30; ++i) shapes += box_at(0.0, 0.05 * (1 + i % 6), 0.03 * (i / 6) - 0.06);
  const RobotModel apart = arm_with(parts_on("link6", 30));
  const RobotModel together = arm_with("", shapes);
  const CollisionChecker a(apart, {});
  const CollisionChecker b(together, {});
  EXPECT_EQ(a.sphere_count(), b.sphere_count());
  Rng random(5);
  int free = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Configuration q = draw(random, apart);
    ASSERT_EQ(a.state_free(q), b.state_free(q)) << q.transpose();
    free += a.state_free(q) ? 1 : 0;
  }
  EXPECT_GT(free, 300);
  EXPECT_LT(free, 2700);
}

TEST(ManyShapes, OfOneLinkAreTaken) {
  std::string shapes;
  for (int i = 0; i < 700; ++i)
    shapes += box_at(0.01 * (i % 7), 0.03 + 0.01 * (i / 7 % 10), 0.01 * (i / 70), 0.01);
  const RobotModel robot = arm_with("", shapes);
  const CollisionChecker fast(robot, {});
  EXPECT_GE(fast.sphere_count(), 700);
  EXPECT_LE(fast.sphere_count(), 1500);
  EXPECT_TRUE(fast.state_free(robot.home("side_1")));
}

TEST(ThickLinks, LargerThanTheMapsDistancesReachAreTaken) {
  const RobotModel robot = arm_with("",
                                    "<collision><origin xyz='0.3 0 0'/><geometry>"
                                    "<sphere radius='0.25'/></geometry></collision>" +
                                        box_at(0.3, 0.0, 0.0, 0.4));
  Rng random(6);
  const VoxelMap map = leaves(random, 25);
  const DistanceField field = field_of(map);
  ASSERT_LT(field.truncation_m(), 0.25);
  const ExactChecker exact(robot);
  CollisionOptions wide;
  wide.map_padding_m = 0.3;  // more than distances are known for
  for (const CollisionOptions& options : {CollisionOptions(), wide}) {
    CollisionChecker fast(robot, {}, options);
    fast.set_map(&field);
    int free = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Configuration q = draw(random, robot);
      const bool fast_free = fast.state_free(q);
      ASSERT_EQ(fast_free, fast.edge_free(q, q));
      ASSERT_FALSE(fast_free && exact.check(q, {}, &map).any());
      free += fast_free ? 1 : 0;
    }
    EXPECT_GT(free, 5);
  }
}

TEST(HugeShapes, GetNoMoreThanSomeThousandSpheres) {
  for (const CollisionShape& shape :
       {CollisionShape::box({500.0, 500.0, 0.01}), CollisionShape::cylinder(0.01, 900.0),
        CollisionShape::box({500.0, 0.001, 0.001})}) {
    const std::size_t count = cover_with_spheres(shape, 0.008).size();
    EXPECT_GE(count, 1U);
    EXPECT_LE(count, 8000U);
  }
}

TEST(Reach, OfARobotInMillimetresIsRefused) {
  const test::OwnFolder folder;
  std::string urdf = *read_file(input("base_on_floor/robot.urdf"));
  const std::string offset = "xyz=\"0.35 0 0\"";
  folder.put("robot.urdf", urdf.replace(urdf.find(offset), offset.size(), "xyz=\"350 0 0\""));
  folder.put("robot.yaml", *read_file(input("base_on_floor/robot.yaml")));
  const auto robot = load_robot(folder.path() / "robot.yaml");
  ASSERT_FALSE(robot);
  EXPECT_TRUE(test::has(robot.error().message, "the arm reaches up to 35"))
      << robot.error().message;
  EXPECT_TRUE(test::has(robot.error().message, "millimetres"));
}

}  // namespace
}  // namespace canopeer
