#include <gtest/gtest.h>

#include "canopeer/import/sdf/fuel_address.h"
#include "canopeer/import/sdf/sdf_world.h"
#include "world_files.h"

namespace canopeer {
namespace {

TEST(FieldFuel, AddressesHaveOwnerNameVersionAndFile) {
  const std::string fuel = "https://fuel.gazebosim.org/1.0/Owner/models/";
  for (const auto& [uri, owner, name, version, file] :
       {std::array<std::string, 5>{fuel + "Bell Pepper", "owner", "Bell Pepper", "", ""},
        {fuel + "Bell%20Pepper/3", "owner", "Bell Pepper", "3", ""},
        {"https://fuel.ignitionrobotics.org/1.0/Owner/models/x/tip", "owner", "x", "", ""},
        {fuel + "X/tip/files/meshes/a%20b.dae", "owner", "X", "", "meshes/a b.dae"},
        {fuel + "x/2/files/a.png", "owner", "x", "2", "a.png"},
        {"https://app.gazebosim.org/Owner/fuel/models/X", "owner", "X", "", ""},
        {"http://example.org/pepper", "", "pepper", "", ""}}) {
    const auto address = parse_fuel_address(uri);
    ASSERT_TRUE(address.has_value()) << uri;
    EXPECT_EQ(address->owner, owner) << uri;
    EXPECT_EQ(address->name, name) << uri;
    EXPECT_EQ(address->version, version) << uri;
    EXPECT_EQ(address->file, file) << uri;
  }
  EXPECT_FALSE(parse_fuel_address("model://x").has_value());
  EXPECT_FALSE(parse_fuel_address("https://").has_value());
}

/// A world that includes a model by `uri`, with one model path and one cache of fetched models.
class FieldFuelWorld : public ::testing::Test {
 protected:
  [[nodiscard]] Expected<SdfWorld> read(const std::string& uri) const {
    const auto world = files_.add_world("<include><uri>" + uri + "</uri><name>p</name></include>");
    return read_sdf_world(world, ModelPaths({files_.models()}, {files_.path() / "fuel"}));
  }
  /// Width of the box that the world shows.
  [[nodiscard]] double width(const std::string& uri) const {
    const auto world = read(uri);
    if (!world || world->visuals.size() != 1) return -1.0;
    return world->visuals.front().primitive.bounds().sizes().x();
  }

  test::WorldFiles files_;
};

TEST_F(FieldFuelWorld, ModelsAreFoundInTheCacheTheNewestFirst) {
  const std::string model = "openrobotics/models/bell pepper/";
  const std::string server = "fuel/fuel.gazebosim.org/";
  files_.add_model("9", test::box_visual("9 1 1"), server + model);
  files_.add_model("10", test::box_visual("10 1 1"), server + model);
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  EXPECT_EQ(width(fuel + "Bell Pepper"), 10.0);
  EXPECT_EQ(width(fuel + "Bell%20Pepper/tip"), 10.0);
  EXPECT_EQ(width(fuel + "Bell Pepper/9"), 9.0);
  EXPECT_EQ(width("https://fuel.ignitionrobotics.org/1.0/openrobotics/models/Bell Pepper"), 10.0);
  EXPECT_EQ(width("https://app.gazebosim.org/OpenRobotics/fuel/models/Bell Pepper"), 10.0);
  files_.add_model("bell_pepper", test::box_visual("1 1 1"));
  EXPECT_EQ(width(fuel + "Bell Pepper"), 1.0);  // the model path comes first
}

TEST_F(FieldFuelWorld, ModelsAreFoundUnderTheModelPathByEitherName) {
  files_.add_model("Bell Pepper", test::box_visual("2 1 1"));
  EXPECT_EQ(width("https://fuel.gazebosim.org/1.0/X/models/Bell%20Pepper"), 2.0);
  EXPECT_EQ(width("model://Bell%20Pepper"), 2.0);
  EXPECT_EQ(width("file://" + (files_.models() / "Bell%20Pepper").string()), 2.0);
}

TEST_F(FieldFuelWorld, MessagesSayEachFolderAndWhatToDo) {
  const auto world = read("https://fuel.gazebosim.org/1.0/OpenRobotics/models/Lost Pepper");
  ASSERT_FALSE(world.has_value());
  const std::string root = files_.path().string();
  for (const std::string& words :
       {std::string("world.world:4: <include><uri>https://"),
        std::string("the network is not read"), std::string("gz fuel download -u"),
        std::string("'lost_pepper', under a --model-path"),
        "searched: " + root + "/models/lost_pepper, " + root + "/models/Lost Pepper, " + root +
            "/fuel/fuel.gazebosim.org/openrobotics/models/lost pepper"}) {
    EXPECT_NE(world.error().message.find(words), std::string::npos) << world.error().message;
  }
}

TEST_F(FieldFuelWorld, AllMissingModelsAreSaidAtOnce) {
  const auto world = read("model://a</uri></include><include><uri>model://b");
  ASSERT_FALSE(world.has_value());
  EXPECT_NE(world.error().message.find("<include><uri>model://a: no such model"),
            std::string::npos);
  EXPECT_NE(world.error().message.find("missing in all: 2 models: model://a model://b"),
            std::string::npos)
      << world.error().message;
}

TEST_F(FieldFuelWorld, AllMissingMeshesAreSaidAtOnce) {
  const auto world =
      files_.add_world("<model name=\"m\"><link name=\"l\">" + test::mesh_visual("a.dae") +
                       "</link><link name=\"k\">" + test::mesh_visual("b.dae") + "</link></model>");
  const auto read = read_sdf_world(world, ModelPaths({}));
  ASSERT_FALSE(read.has_value());
  for (const char* words :
       {"world.world:4: <mesh><uri>a.dae: no such file; visual 'visual' of model "
        "'m' refers to it (searched: ",
        "; missing in all: 2 meshes: a.dae b.dae"}) {
    EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().message;
  }
}

TEST_F(FieldFuelWorld, MeshesHaveAddressesOnTheNetworkToo) {
  const std::string folder = "fuel/fuel.gazebosim.org/openrobotics/models/pepper/1/";
  const auto mesh = files_.add(folder + "meshes/my pepper.obj", "x");
  const auto world = files_.add_world(
      "<model name=\"m\"><link name=\"l\">" +
      test::mesh_visual(
          "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Pepper/tip/files/meshes/"
          "my%20pepper.obj") +
      "</link></model>");
  const auto read = read_sdf_world(world, ModelPaths({}, {files_.path() / "fuel"}));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->visuals.front().mesh, mesh);
}

}  // namespace
}  // namespace canopeer
