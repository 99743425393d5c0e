#include "canopeer/config/robot_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "../import/mesh_writers.h"
#include "canopeer/base/atomic_file.h"
#include "canopeer/config/robot_mesh.h"
#include "canopeer/config/srdf.h"
#include "canopeer/config/urdf.h"

namespace canopeer {
namespace {

const std::filesystem::path kRobot = CANOPEER_SOURCE_DIR "/robots/ur5e_trolley";

std::string shipped(const char* name) { return *read_file(kRobot / name); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Loads the shipped robot with one of its files changed.
std::string message_with(const char* changed_file, const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto directory =
      std::filesystem::temp_directory_path() / (std::string("canopeer_") + test->name());
  std::filesystem::create_directories(directory);
  for (const char* name : {"robot.yaml", "ur5e_trolley.urdf", "ur5e_trolley.srdf"})
    EXPECT_TRUE(
        write_file(directory / name, name == std::string(changed_file) ? text : shipped(name)));
  const auto robot = load_robot(directory / "robot.yaml");
  std::filesystem::remove_all(directory);
  if (robot) return "accepted";
  std::string message = robot.error().message;
  if (message.rfind(directory.string() + "/", 0) == 0)
    message.erase(0, directory.string().size() + 1);
  return message;
}

std::string yaml_message(const std::string& from, const std::string& to) {
  return message_with("robot.yaml", replaced(shipped("robot.yaml"), from, to));
}

TEST(RobotFile, ReadsTheShippedRobot) {
  const auto robot = load_robot(kRobot / "robot.yaml");
  ASSERT_TRUE(robot) << robot.error().message;
  EXPECT_EQ(robot->dof(), 6);
  EXPECT_EQ(robot->sides(), 2);
  EXPECT_DOUBLE_EQ(robot->limits().acceleration[3], 1.0);
  EXPECT_NEAR(robot->limits().upper[2], 3.14159265, 1e-8);
  EXPECT_DOUBLE_EQ(robot->travel_axis().upper, 3.0);
  EXPECT_DOUBLE_EQ(robot->lift_axis().upper, 2.2);
}

TEST(RobotFile, LaysRailsOfAnotherLength) {
  const auto robot = load_robot(kRobot / "robot_long.yaml");
  ASSERT_TRUE(robot) << robot.error().message;
  EXPECT_DOUBLE_EQ(robot->travel_axis().lower, 0.0);
  EXPECT_DOUBLE_EQ(robot->travel_axis().upper, 100.0);
  EXPECT_DOUBLE_EQ(robot->lift_axis().upper, 2.2);
  EXPECT_EQ(yaml_message("lift_joint:", "travel_limits_m: [4, 1]\nlift_joint:"),
            "robot.yaml:11: travel_limits_m: expected [low, high] with low < high");
}

TEST(RobotFile, NamesFileLineAndKeyOfBadYaml) {
  EXPECT_EQ(yaml_message("camera_frame:", "camera_fame:"),
            "robot.yaml:8: unknown key 'camera_fame'; did you mean 'camera_frame'?");
  EXPECT_EQ(yaml_message("z_m: [0.01, 1.17]", "z_m: [1.17, 0.01]"),
            "robot.yaml:27: z_m: expected [low, high] with low < high");
  EXPECT_EQ(yaml_message("xyz_m: [0.0, -2.0, 0.12]", "xyz_m: [0.0, 2 m, 0.12]"),
            "robot.yaml:15: xyz_m: expected a number in metres, found '2 m'");
  EXPECT_EQ(yaml_message("xyz_m:", "xyz_mm:"),
            "robot.yaml:15: unknown key 'xyz_mm'; did you mean 'xyz_m'?");
  EXPECT_EQ(yaml_message("travel_joint: trolley_travel", "travel_joint: trolley_lift_x"),
            "robot.yaml: no joint is called 'trolley_lift_x' (trolley axis)");
  EXPECT_NE(yaml_message("urdf: ur5e", "urdf: ur6e").find("ur6e_trolley.urdf: cannot read"),
            std::string::npos);
}

TEST(Urdf, NamesTheLineOfMalformedXml) {
  const std::string urdf = shipped("ur5e_trolley.urdf");
  const std::string message = message_with("ur5e_trolley.urdf", replaced(urdf, "</joint>", ""));
  EXPECT_NE(message.find("ur5e_trolley.urdf:"), std::string::npos) << message;
  EXPECT_NE(message.find("malformed XML"), std::string::npos) << message;
}

TEST(Urdf, SaysHowToExpandXacro) {
  const auto robot = parse_urdf(
      "<robot name='r' xmlns:xacro='http://x'>\n<xacro:include filename='a'/>\n</robot>", "a.urdf");
  ASSERT_FALSE(robot);
  EXPECT_EQ(robot.error().message,
            "a.urdf:2: <xacro:include> is xacro; expand the file first: xacro a.urdf > robot.urdf");
}

TEST(Urdf, KnowsXacroInNumbersToo) {
  const auto robot = parse_urdf(
      "<robot name='r'>\n<link name='a'>\n<collision><origin xyz='0 0 ${h/2}'/>"
      "<geometry><sphere radius='1'/></geometry></collision></link></robot>",
      "a.urdf");
  ASSERT_FALSE(robot);
  EXPECT_EQ(robot.error().message,
            "a.urdf:3: xyz=\"0 0 ${h/2}\" is xacro; expand the file first: xacro a.urdf > "
            "robot.urdf");
}

TEST(RobotFile, NamesEveryJointThatLacksLimitsAndTheOneAHomeStateBreaks) {
  std::string urdf = shipped("ur5e_trolley.urdf");
  for (const std::string joint : {"elbow_joint", "wrist_2_joint"}) {
    const std::string attribute = "velocity=";
    urdf.replace(urdf.find(attribute, urdf.find("\"" + joint + "\"")), attribute.size(), "speed=");
  }
  const std::string message = message_with("ur5e_trolley.urdf", urdf);
  EXPECT_NE(message.find("'elbow_joint' needs finite limits"), std::string::npos) << message;
  EXPECT_NE(message.find("'wrist_2_joint' needs finite limits"), std::string::npos) << message;
  EXPECT_EQ(yaml_message("side_1: [0.0, -0.7853981633974483, 1.5", "side_1: [0.0, -0.78, 9.5"),
            "robot.yaml: home state 'side_1': joint 'elbow_joint' at 9.570796326794897 is "
            "outside its limits -3.141592653589793 ... 3.141592653589793");
}

TEST(Urdf, PassesOnWhatTheParserDislikesWithTheLine) {
  ::testing::internal::CaptureStderr();
  const std::string text =
      "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n"
      "<joint name='j' type='revolute'>\n<parent link='a'/><child link='b'/>\n</joint>\n</robot>";
  const auto robot = parse_urdf(text, "a.urdf");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(robot);
  EXPECT_EQ(robot.error().message.rfind("a.urdf:4: ", 0), 0U) << robot.error().message;
}

/// A folder of its own for the running test, removed afterwards.
class RobotMeshes : public ::testing::Test {
 protected:
  RobotMeshes()
      : directory_(std::filesystem::temp_directory_path() /
                   (std::string("canopeer_meshes_") +
                    ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(directory_ / "my_arm" / "urdf");
    std::filesystem::create_directories(directory_ / "my_arm" / "meshes");
  }
  ~RobotMeshes() override { std::filesystem::remove_all(directory_); }

  /// A wedge of 2 x 3 x 4 as OBJ.
  void write_wedge(const std::filesystem::path& path) const {
    ASSERT_TRUE(
        write_file(path,
                   "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nv 2 0 4\nv 0 3 4\n"
                   "f 1 3 2\nf 4 5 6\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\nf 3 1 4\nf 3 4 6\n"));
  }
  [[nodiscard]] Expected<RobotDescription> parse(const std::string& mesh,
                                                 const std::string& scale = "") const {
    return parse_urdf("<robot name='r'>\n<link name='a'>\n<collision><geometry><mesh filename='" +
                          mesh + "'" + scale + "/></geometry></collision></link></robot>",
                      "a.urdf", {directory_ / "my_arm" / "urdf", {}});
  }

  std::filesystem::path directory_;
};

TEST_F(RobotMeshes, AreFoundInThePackageAndBesideTheFile) {
  write_wedge(directory_ / "my_arm" / "meshes" / "wedge.obj");
  for (const char* name : {"package://my_arm/meshes/wedge.obj", "../meshes/wedge.obj"}) {
    const auto robot = parse(name, " scale='0.1 0.1 0.1'");
    ASSERT_TRUE(robot) << robot.error().message;
    const CollisionShape& shape = robot->links.at(0).collision.at(0);
    EXPECT_EQ(shape.kind, ShapeKind::kMesh);
    EXPECT_TRUE(shape.size_m.isApprox(Vec3(0.2, 0.3, 0.4), 1e-6));
    EXPECT_EQ(shape.mesh->triangles.triangles.size(), 8U);
    // The solid around it holds all its vertices, and more than the wedge: 26 directions only.
    for (const auto& vertex : shape.mesh->triangles.vertices) {
      for (const auto& plane : shape.mesh->planes)
        EXPECT_LE(plane.normal.dot(vertex.cast<double>()), plane.offset_m + 1e-12);
    }
  }
}

TEST_F(RobotMeshes, ThatAreMissingAreNamedWithTheLineAndWhereTheyWereLookedFor) {
  const auto robot = parse("package://my_arm/meshes/none.stl");
  ASSERT_FALSE(robot);
  EXPECT_EQ(
      robot.error().message.rfind("a.urdf:3: link 'a': mesh 'package://my_arm/meshes/none.stl' "
                                  "not found; looked in ",
                                  0),
      0U)
      << robot.error().message;
  EXPECT_NE(robot.error().message.find("package_path"), std::string::npos);
  const auto web = parse("http://example.org/a.stl");
  ASSERT_FALSE(web);
  EXPECT_NE(web.error().message.find("expected package://"), std::string::npos);
}

/// Where the shape's triangles lie in its link.
Box box_in_link(const CollisionShape& shape) {
  Box box;
  for (const auto& vertex : shape.mesh->triangles.vertices)
    box.extend(shape.T_link_shape * Vec3(vertex.cast<double>()));
  return box;
}

TEST_F(RobotMeshes, OfEveryFormatMeanTheSameScaledAndPlacedByTheirElement) {
  const test::Painted ball{"grey", test::ball(Vec3(0.1, 0.2, 0.3), 0.2), {90, 90, 90}, ""};
  const auto meshes = directory_ / "my_arm" / "meshes";
  test::DaeStyle centimetres;
  centimetres.unit_m = 0.01;
  centimetres.unit_name = "centimeter";
  for (const auto& [name, text] :
       {std::pair("a.stl", test::ascii_stl(ball.mesh)),
        std::pair("b.stl", test::binary_stl(ball.mesh)),
        std::pair("c.obj", test::obj({ball}, "none.mtl")), std::pair("d.dae", test::dae({ball})),
        std::pair("e.dae", test::dae({ball}, centimetres))}) {
    ASSERT_TRUE(write_file(meshes / name, text));
    for (const std::string tag : {"collision", "visual"}) {
      // Scaled first, then turned about z, then moved.
      const auto robot = parse_urdf(
          "<robot name='r'><link name='a'><" + tag +
              "><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><geometry><mesh filename='" +
              "package://my_arm/meshes/" + name + "' scale='2 1 0.5'/></geometry></" + tag +
              "></link></robot>",
          "a.urdf", {directory_ / "my_arm" / "urdf", {}});
      ASSERT_TRUE(robot) << robot.error().message;
      const Link& link = robot->links.at(0);
      EXPECT_TRUE(robot->notices.empty()) << robot->notices.front();
      ASSERT_EQ(link.collision.size() + link.visual.size(), 1U) << name;
      const Box box = box_in_link(tag == "visual" ? link.visual.at(0) : link.collision.at(0));
      EXPECT_TRUE(box.min().isApprox(Vec3(1.0 - 0.4, 2.0 - 0.2, 3.05), 1e-5))
          << name << ": " << box.min().transpose();
      EXPECT_TRUE(box.max().isApprox(Vec3(1.0 - 0.0, 2.0 + 0.6, 3.25), 1e-5))
          << name << ": " << box.max().transpose();
    }
  }
}

TEST_F(RobotMeshes, AreFoundThroughThePackagePath) {
  const auto elsewhere = directory_ / "elsewhere" / "my_arm";
  std::filesystem::create_directories(elsewhere);
  write_wedge(elsewhere / "wedge.obj");
  const std::string urdf =
      "<robot name='r'><link name='a'><collision><geometry>"
      "<mesh filename='package://my_arm/wedge.obj'/></geometry></collision></link></robot>";
  EXPECT_FALSE(parse_urdf(urdf, "a.urdf", {directory_ / "my_arm" / "urdf", {}}));
  for (const auto& folder : {directory_ / "elsewhere", elsewhere})
    EXPECT_TRUE(parse_urdf(urdf, "a.urdf", {directory_ / "my_arm" / "urdf", {folder}}));
}

TEST_F(RobotMeshes, AreFoundInThePackageOfAFileInTheWorkingDirectory) {
  const auto here = std::filesystem::current_path();
  const std::string package = here.filename().string();
  const auto mesh = here / "canopeer_wedge_in_working_directory.obj";
  write_wedge(mesh);
  const auto found =
      RobotMeshReader({"", {}}).find("package://" + package + "/" + mesh.filename().string());
  std::filesystem::remove(mesh);
  EXPECT_TRUE(found) << found.error().what;
}

TEST_F(RobotMeshes, OfOneLinkAreKeptApartEachAtItsOrigin) {
  write_wedge(directory_ / "my_arm" / "meshes" / "wedge.obj");
  std::string urdf = "<robot name='r'><link name='a'>";
  for (const std::string x : {"0", "5"})
    urdf += "<collision><origin xyz='" + x +
            " 0 0'/><geometry><mesh filename='../meshes/wedge.obj'/></geometry></collision>";
  urdf += "<collision><geometry><sphere radius='0.5'/></geometry></collision></link></robot>";
  const auto robot = parse_urdf(urdf, "a.urdf", {directory_ / "my_arm" / "urdf", {}});
  ASSERT_TRUE(robot) << robot.error().message;
  const auto& shapes = robot->links.at(0).collision;
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_TRUE(box_in_link(shapes[0]).max().isApprox(Vec3(2.0, 3.0, 4.0), 1e-6));
  EXPECT_TRUE(box_in_link(shapes[1]).max().isApprox(Vec3(7.0, 3.0, 4.0), 1e-6));
  EXPECT_EQ(shapes[2].kind, ShapeKind::kSphere);
}

TEST_F(RobotMeshes, ThatAreMirroredKeepTheirInsideInside) {
  write_wedge(directory_ / "my_arm" / "meshes" / "wedge.obj");
  const auto robot = parse("../meshes/wedge.obj", " scale='-1 1 1'");
  ASSERT_TRUE(robot) << robot.error().message;
  const CollisionShape& shape = robot->links.at(0).collision.at(0);
  EXPECT_TRUE(box_in_link(shape).min().isApprox(Vec3(-2.0, 0.0, 0.0), 1e-6));
  double volume = 0.0;  // positive where the triangles face outwards
  for (const auto& t : shape.mesh->triangles.triangles) {
    const auto& v = shape.mesh->triangles.vertices;
    volume += v[t[0]].cast<double>().dot(v[t[1]].cast<double>().cross(v[t[2]].cast<double>())) / 6;
  }
  EXPECT_NEAR(volume, 12.0, 1e-5);
}

TEST_F(RobotMeshes, ThatAreForDisplayOnlyMayBeMissing) {
  const auto robot = parse_urdf(
      "<robot name='r'><link name='a'><visual><geometry><mesh filename='none.dae'/></geometry>"
      "</visual></link></robot>",
      "a.urdf", {directory_ / "my_arm" / "urdf", {}});
  ASSERT_TRUE(robot) << robot.error().message;
  ASSERT_EQ(robot->notices.size(), 1U);
  EXPECT_NE(robot->notices[0].find("none.dae"), std::string::npos);
}

TEST(RobotFile, ReadsTheArmOnARail) {
  const auto robot = load_robot(CANOPEER_SOURCE_DIR "/robots/panda_rail/robot.yaml");
  ASSERT_TRUE(robot) << robot.error().message;
  EXPECT_EQ(robot->dof(), 8);
  EXPECT_EQ(robot->arm_joint_type(0), JointType::kPrismatic);
  EXPECT_DOUBLE_EQ(robot->limits().upper[0], 0.5);
}

TEST(Urdf, ReadsFramesAxesLimitsAndShapes) {
  const auto robot = parse_urdf(
      "<robot name='r'>"
      "<link name='a'/><link name='b'><collision><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/>"
      "<geometry><cylinder radius='0.1' length='0.4'/></geometry></collision></link>"
      "<joint name='j' type='prismatic'><parent link='a'/><child link='b'/>"
      "<origin xyz='0 0 1' rpy='0 0 0'/><axis xyz='0 2 0'/>"
      "<limit lower='-1' upper='2' velocity='3' effort='4'/></joint></robot>",
      "a.urdf");
  ASSERT_TRUE(robot) << robot.error().message;
  const Joint& joint = robot->joints.at(0);
  EXPECT_EQ(joint.type, JointType::kPrismatic);
  EXPECT_TRUE(joint.axis.isApprox(Vec3::UnitY()));
  EXPECT_EQ(joint.lower, -1.0);
  EXPECT_EQ(joint.upper, 2.0);
  EXPECT_EQ(joint.velocity_limit, 3.0);
  const CollisionShape& shape = robot->links.at(1).collision.at(0);
  EXPECT_EQ(shape.kind, ShapeKind::kCylinder);
  EXPECT_TRUE((shape.T_link_shape * Vec3::UnitX()).isApprox(Vec3(1, 3, 3)));
}

TEST(Srdf, NamesTheLineOfAPairThatIsNone) {
  const std::string message = message_with(
      "ur5e_trolley.srdf", replaced(shipped("ur5e_trolley.srdf"), "link2=\"", "link_2=\""));
  EXPECT_EQ(message, "ur5e_trolley.srdf:5: <disable_collisions> needs link2");
}

}  // namespace
}  // namespace canopeer
