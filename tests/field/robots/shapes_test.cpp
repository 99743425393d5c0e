// Shapes as they come: capsules, shapes of no size, flat and folded meshes.

#include "canopeer/base/rng.h"
#include "canopeer/config/urdf.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::has;
using test::mesh;
using test::one_link;

std::string shape(const std::string& geometry, const std::string& origin = "") {
  return "<collision>" + origin + "<geometry>" + geometry + "</geometry></collision>\n";
}

TEST(Capsule, IsWhatIsWithinItsRadiusOfItsAxis) {
  for (const std::string prefix : {"", "drake:"}) {
    const auto robot =
        parse_urdf(one_link(shape("<" + prefix + "capsule radius='0.05' length='0.3'/>",
                                  "<origin xyz='0.1 0.2 0.3' rpy='0 1.5707963267948966 0'/>")),
                   "a.urdf");
    ASSERT_TRUE(robot) << robot.error().message;
    const auto& shapes = robot->links.at(0).collision;
    ASSERT_EQ(shapes.size(), 3U);
    Rng random(1);
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 p{random.uniform(-0.2, 0.4), random.uniform(0.1, 0.3), random.uniform(0.2, 0.4)};
      double distance = 1.0;
      for (const CollisionShape& part : shapes)
        distance = std::min(distance, signed_distance(part, part.T_link_shape.inverse() * p));
      const Vec3 on_axis(std::clamp(p.x(), 0.1 - 0.15, 0.1 + 0.15), 0.2, 0.3);
      const double expected = (p - on_axis).norm() - 0.05;
      ASSERT_EQ(distance > 0.0, expected > 0.0) << p.transpose();
      if (expected > 0.0) {
        ASSERT_NEAR(distance, expected, 1e-9);
      }
    }
  }
}

TEST(Shape, OfNoSizeIsLeftOutAndSaid) {
  const auto robot =
      parse_urdf(one_link(shape("<box size='0 0 0'/>") + shape("<sphere radius='0.1'/>") +
                          shape("<cylinder radius='0.1' length='0'/>") + shape("") +
                          shape("<capsule radius='0.1' length='0'/>")),
                 "a.urdf");
  ASSERT_TRUE(robot) << robot.error().message;
  EXPECT_EQ(robot->links.at(0).collision.size(), 2U);  // the sphere, and the capsule that is one
  ASSERT_EQ(robot->notices.size(), 3U);
  EXPECT_EQ(robot->notices[0], "a.urdf:3: link 'a': a <box> of no size is left out");
  EXPECT_EQ(robot->notices[2], "a.urdf:6: link 'a': a <collision> without a shape is left out");
}

TEST(Shape, ThatIsNoneIsNamedWithItsLine) {
  for (const auto& [geometry, expected] :
       {std::pair("<cone radius='1' length='2'/>",
                  "a.urdf:3: link 'a': <cone> is no shape; expected box, cylinder, sphere, capsule "
                  "or mesh"),
        std::pair("<box size='1 2'/>",
                  "a.urdf:3: link 'a': <box> needs three numbers in size, none below 0"),
        std::pair("<sphere radius='-1'/>",
                  "a.urdf:3: link 'a': <sphere> needs a number in radius, none below 0"),
        std::pair("<cylinder radius='nan' length='1'/>",
                  "a.urdf:3: link 'a': <cylinder> needs numbers in radius and length, none below "
                  "0"),
        std::pair("<sphere radius='1e300'/>",
                  "a.urdf:3: link 'a': <sphere> needs a number in radius, none below 0")}) {
    const auto robot = parse_urdf(one_link(shape(geometry)), "a.urdf");
    ASSERT_FALSE(robot);
    EXPECT_EQ(robot.error().message, expected);
  }
}

TEST(Urdf, WhoseMaterialsAndMassesAreOddIsRead) {
  const auto robot = parse_urdf(
      "<robot name='r'><material name='grey'/><material name='grey'/><link name='a'>"
      "<inertial><mass/></inertial><visual><geometry><cone/></geometry><material name='none'/>"
      "</visual>" +
          shape("<sphere radius='0.1'/>") + "</link></robot>",
      "a.urdf");
  ASSERT_TRUE(robot) << robot.error().message;
  EXPECT_EQ(robot->links.at(0).collision.size(), 1U);
  ASSERT_EQ(robot->notices.size(), 1U);
  EXPECT_TRUE(has(robot->notices[0], "<cone> is no shape")) << robot->notices[0];
}

TEST(Mesh, ThatIsFlatOrFoldedIsCheckedAsAnyOther) {
  const test::OwnFolder folder;
  folder.put("sheet.obj", "v -0.2 -0.2 0\nv 0.2 -0.2 0\nv 0.2 0.2 0\nv -0.2 0.2 0\nf 1 2 3 4\n");
  folder.put("needle.obj", "v 0 0 0\nv 0.3 0 0\nv 0.1 0 0\nv 0 0 0.001\nf 1 2 3\nf 1 2 4\n");
  folder.put("point.obj", "v 0.1 0 0\nv 0.1 0 0\nv 0.1 0 0\nv 0.1 0 1e-9\nf 1 2 3\nf 1 2 4\n");
  std::string arm = *read_file(test::input("base_on_floor/robot.urdf"));
  const std::string last = "<link name=\"link6\">";
  const auto at = arm.find(last) + last.size();
  const RobotSetup setup = test::robot_of("base_on_floor/robot.yaml").setup();
  for (const char* name : {"sheet.obj", "needle.obj", "point.obj"}) {
    std::string urdf = arm;
    auto robot = parse_urdf(urdf.insert(at, mesh(name)), "a.urdf", {{folder.path(), {}}});
    if (!robot) {  // a reader may drop triangles without area; then it says so
      EXPECT_TRUE(has(robot.error().message, "cannot be used")) << robot.error().message;
      continue;
    }
    for (Joint& joint : robot->joints) joint.acceleration_limit = 1.0;
    robot->neighbours_may_touch = true;
    const auto model = RobotModel::make(std::move(*robot), setup);
    ASSERT_TRUE(model) << model.error().message;
    const CollisionChecker fast(*model, {});
    const ExactChecker exact(*model);
    Rng random(2);
    int free = 0;
    for (int trial = 0; trial < 300; ++trial) {
      Configuration q(6);
      for (double& joint : q) joint = random.uniform(-2.9, 2.9);
      const bool fast_free = fast.state_free(q);
      ASSERT_FALSE(fast_free && exact.check(q, {}).any()) << name << " " << q.transpose();
      free += fast_free ? 1 : 0;
    }
    EXPECT_GT(free, 20) << name;
  }
}

TEST(Mesh, ReadForTwoLinksIsOne) {
  const test::OwnFolder folder;
  folder.put("corner.obj", test::corner_obj(0.1));
  const auto robot = parse_urdf(
      one_link(mesh("corner.obj") + mesh("./corner.obj") + mesh("corner.obj", "scale='2 2 2'")),
      "a.urdf", {{folder.path(), {}}});
  ASSERT_TRUE(robot) << robot.error().message;
  const auto& shapes = robot->links.at(0).collision;
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].mesh, shapes[1].mesh);
  EXPECT_NE(shapes[0].mesh, shapes[2].mesh);
}

TEST(Mesh, InMillimetresIsAskedAbout) {
  const test::OwnFolder folder;
  folder.put("corner.obj", test::corner_obj(120.0));
  const auto robot = parse_urdf(one_link(mesh("corner.obj")), "a.urdf", {{folder.path(), {}}});
  ASSERT_TRUE(robot) << robot.error().message;
  ASSERT_EQ(robot->notices.size(), 1U);
  EXPECT_TRUE(has(robot->notices[0], "is 120 m across: in millimetres?")) << robot->notices[0];
}

}  // namespace
}  // namespace canopeer
