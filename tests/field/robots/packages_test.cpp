// Where meshes are found, and what is said of those that are not.

#include "canopeer/config/robot_mesh.h"
#include "canopeer/config/urdf.h"
#include "small_arm.h"

namespace canopeer {
namespace {

using test::corner_obj;
using test::has;
using test::mesh;
using test::notices_of;
using test::one_link;

TEST(Package, IsFoundByTheNameInItsPackageXml) {
  const RobotModel robot = test::robot_of("package_name/robot.yaml");
  EXPECT_EQ(notices_of(robot), "");
  const auto& base = robot.links()[static_cast<std::size_t>(robot.link_index("base"))].collision;
  ASSERT_EQ(base.size(), 1U);
  EXPECT_TRUE(base[0].size_m.isApprox(Vec3::Constant(0.1), 1e-6));
  // A blank in its name, the ending in capitals, and mirrored: what was outside is outside still.
  const auto& elbow = robot.links()[static_cast<std::size_t>(robot.link_index("link3"))].collision;
  ASSERT_EQ(elbow.size(), 1U);
  const TriangleMesh& triangles = elbow[0].mesh->triangles;
  EXPECT_NEAR(triangles.volume(), 0.05 * 0.05 * 0.05 / 6.0, 1e-9);
  EXPECT_NEAR((elbow[0].T_link_shape.translation()).y(), -0.025, 1e-6);
}

class Meshes : public ::testing::Test {
 protected:
  Meshes() { std::filesystem::create_directories(folder_.path() / "arm" / "urdf"); }

  [[nodiscard]] std::string found(const std::string& name,
                                  std::vector<std::filesystem::path> package_path = {}) const {
    RobotMeshReader reader({folder_.path() / "arm" / "urdf", std::move(package_path)});
    const auto path = reader.find(name);
    if (!path) return path.error().what + " near " + path.error().near;
    return std::filesystem::relative(*path, folder_.path()).string();
  }
  [[nodiscard]] std::string message(const std::string& shapes) const {
    const auto robot =
        parse_urdf(one_link(shapes), "a.urdf", {{folder_.path() / "arm" / "urdf", {}}});
    return robot ? "read" : robot.error().message;
  }

  test::OwnFolder folder_;
};

TEST_F(Meshes, AreFoundHoweverTheyAreSpelled) {
  folder_.put("arm/meshes/fore arm.STL", "");
  folder_.put("arm/urdf/own.obj", "");
  const std::string absolute = (folder_.path() / "arm").string();
  for (const std::string& name :
       {std::string("package://arm/meshes/fore arm.STL"),
        std::string("package://arm/meshes/fore%20arm.STL"),
        std::string("package://arm/meshes\\fore arm.STL"),
        std::string("package:///arm/meshes/fore arm.STL"),
        std::string("model://arm/meshes/fore arm.STL"), std::string("../meshes/fore arm.STL"),
        std::string("..\\meshes\\fore%20arm.STL"), std::string("  ../meshes/fore arm.STL\n"),
        "file://" + absolute + "/meshes/fore%20arm.STL",
        "file:" + absolute + "/meshes/fore arm.STL",
        "file://localhost" + absolute + "/meshes/fore arm.STL",
        absolute + "/meshes/fore arm.STL"}) {
    EXPECT_EQ(found(name), "arm/meshes/fore arm.STL") << name;
  }
  EXPECT_EQ(found("file://own.obj"), "arm/urdf/own.obj");
  // A file whose name really has %20 in it comes first.
  folder_.put("arm/meshes/fore%20arm.STL", "");
  EXPECT_EQ(found("package://arm/meshes/fore%20arm.STL"), "arm/meshes/fore%20arm.STL");
}

TEST_F(Meshes, OfPackagesOfOtherNamesAreFoundBesideAboveAndInWorkspaces) {
  const auto package = [](const std::string& name) {
    return "<package><name>" + name + "</name></package>";
  };
  folder_.put("arm/package.xml", package("arm_description"));
  folder_.put("arm/meshes/a.stl", "");
  folder_.put("gripper-v2/package.xml", package("gripper_description"));
  folder_.put("gripper-v2/meshes/g.stl", "");
  folder_.put("ws/src/vendor/camera/package.xml", package("camera_description"));
  folder_.put("ws/src/vendor/camera/meshes/c.stl", "");
  folder_.put("prefix/share/tool_description/meshes/t.stl", "");
  EXPECT_EQ(found("package://arm_description/meshes/a.stl"), "arm/meshes/a.stl");
  EXPECT_EQ(found("package://gripper_description/meshes/g.stl"), "gripper-v2/meshes/g.stl");
  const std::string camera = "package://camera_description/meshes/c.stl";
  EXPECT_TRUE(has(found(camera), "not found"));
  EXPECT_EQ(found(camera, {folder_.path() / "ws"}), "ws/src/vendor/camera/meshes/c.stl");
  EXPECT_EQ(found(camera, {folder_.path() / "ws/src/vendor/camera"}),
            "ws/src/vendor/camera/meshes/c.stl");
  EXPECT_EQ(found("package://tool_description/meshes/t.stl", {folder_.path() / "prefix"}),
            "prefix/share/tool_description/meshes/t.stl");
}

TEST_F(Meshes, ThatAreMissingAreSaidAtOnceWithWhatThereIs) {
  folder_.put("arm/meshes/base.STL", "");
  folder_.put("arm/meshes/elbow_v2.stl", "");
  const std::string text =
      message(mesh("package://arm/meshes/base.stl") + mesh("package://arm/meshes/elbow_v3.stl") +
              mesh("package://arm/meshes/base.stl") + mesh("package://hand/meshes/finger.stl"));
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_TRUE(has(text,
                  "a.urdf:3: link 'a': mesh 'package://arm/meshes/base.stl' not found; looked "
                  "in " +
                      (folder_.path() / "arm").string()))
      << text;
  EXPECT_TRUE(has(text, "there is " + (folder_.path() / "arm/meshes/base.STL").string())) << text;
  EXPECT_TRUE(has(text, "; 1 more, in line 4 'package://arm/meshes/elbow_v3.stl' (there is " +
                            (folder_.path() / "arm/meshes/elbow_v2.stl").string()))
      << text;
  EXPECT_TRUE(has(text, "a.urdf:6: link 'a': mesh 'package://hand/meshes/finger.stl'")) << text;
  EXPECT_TRUE(has(text, "for a package 'hand'")) << text;
}

TEST_F(Meshes, OfAnotherMachinesPathsAreFoundNearBy) {
  folder_.put("arm/meshes/base.stl", "");
  EXPECT_TRUE(has(found("file:///home/jo/ws/src/arm/meshes/base.stl"),
                  "near " + (folder_.path() / "arm/meshes/base.stl").string()));
  EXPECT_TRUE(has(found("C:\\work\\arm\\meshes\\base.stl"),
                  "near " + (folder_.path() / "arm/meshes/base.stl").string()));
}

TEST_F(Meshes, OfAPackageThatIsNearlyThereNameIt) {
  folder_.put("arm/package.xml", "<package><name>my_arm_description</name></package>");
  EXPECT_TRUE(has(found("package://my_arm_descriptions/base.stl"),
                  "there is a package 'my_arm_description'"));
}

TEST_F(Meshes, ThatAreBrokenOrEmptyAreErrorsInOneLine) {
  folder_.put("arm/urdf/empty.stl", "");
  folder_.put("arm/urdf/text.dae", "no mesh");
  folder_.put("arm/urdf/points.obj", "v 0 0 0\nv 1 0 0\n");
  folder_.put("arm/urdf/far.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n");
  for (const char* name : {"empty.stl", "text.dae", "points.obj", "far.obj"}) {
    const std::string text = message(mesh(name));
    EXPECT_TRUE(has(text, "a.urdf:3: link 'a': mesh '" + std::string(name) + "' cannot be used: "))
        << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
  folder_.put("arm/urdf/good.obj", corner_obj(0.1));
  EXPECT_TRUE(has(message(mesh("good.obj", "scale='1 0 1'")), "scale with a zero"));
  EXPECT_TRUE(has(message(mesh("good.obj", "scale='1 1'")), "three numbers in scale"));
  EXPECT_EQ(message(mesh("good.obj", "scale='+1 1e-3 -1'")), "read");
}

}  // namespace
}  // namespace canopeer
