#include "canopeer/import/sdf/sdf_includes.h"

#include <gtest/gtest.h>

#include "canopeer/import/sdf/sdf_world.h"
#include "world_files.h"

namespace canopeer {
namespace {

TEST(SdfIncludes, TheNewestFileThatIsKnownIsTaken) {
  const test::WorldFiles files;
  const auto chosen = [&](const std::string& choices) {
    files.add("m/model.config", "<model><name>m</name>" + choices + "</model>");
    const auto path = sdf_in_model_folder(files.path() / "m");
    return path ? path->filename().string() : path.error().message;
  };
  const std::string old = "<sdf version=\"1.4\">old.sdf</sdf>";
  const std::string fresh = "<sdf version=\"1.10\">fresh.sdf</sdf>";
  const std::string strange = "<sdf version=\"2.0\">strange.sdf</sdf>";
  EXPECT_EQ(chosen(old + fresh + strange), "fresh.sdf");
  EXPECT_EQ(chosen(strange + "<sdf version=\"1.9\">nine.sdf</sdf>" + fresh), "fresh.sdf");
  EXPECT_EQ(chosen("<sdf>bare.sdf</sdf>"), "bare.sdf");
  EXPECT_EQ(chosen("<sdf>bare.sdf</sdf>" + old), "old.sdf");
  EXPECT_EQ(chosen(strange), "strange.sdf");
  EXPECT_NE(chosen("").find("model.config: expected <model> with <sdf"), std::string::npos);
  EXPECT_NE(chosen("<sdf").find("model.config:1: is no sound XML"), std::string::npos);
  std::filesystem::remove(files.path() / "m/model.config");
  EXPECT_NE(sdf_in_model_folder(files.path() / "m").error().message.find("no model.config"),
            std::string::npos);
  files.add("m/manifest.xml", "<model>" + old + "</model>");
  EXPECT_EQ(sdf_in_model_folder(files.path() / "m")->filename(), "old.sdf");
}

TEST(SdfIncludes, ModelsHaveTheLastNameOfTheirAddress) {
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  EXPECT_EQ(SdfIncludes::model_name("model://sun"), "sun");
  EXPECT_EQ(SdfIncludes::model_name("model://Rows/Bay/"), "Bay");
  EXPECT_EQ(SdfIncludes::model_name(fuel + "Ground Plane"), "ground_plane");
  EXPECT_EQ(SdfIncludes::model_name(fuel + "Ground%20Plane/2"), "ground_plane");
  EXPECT_EQ(SdfIncludes::model_name("https://example.org/pepper"), "pepper");
}

TEST(SdfIncludes, ModelsOfTheNetworkAreTakenFromTheModelPath) {
  const test::WorldFiles files;
  const std::string fuel = "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  files.add_model("pepper_plant", test::box_visual("1 1 1"));
  const auto path =
      files.add_world(fuel + "Sun</uri></include>" + fuel + "Ground Plane</uri></include>" + fuel +
                      "Pepper Plant/3</uri><name>p</name></include>");
  const auto world = read_sdf_world(path, ModelPaths({files.models()}));
  ASSERT_TRUE(world.has_value()) << world.error().message;
  ASSERT_EQ(world->visuals.size(), 2U);
  EXPECT_EQ(world->visuals[0].names.model, "ground_plane");
  EXPECT_EQ(world->visuals[1].names.model, "p");
  const auto lost =
      read_sdf_world(files.add_world(fuel + "Lost</uri></include>"), ModelPaths({files.models()}));
  ASSERT_FALSE(lost.has_value());
  for (const char* word : {"world.world:4: <include><uri>https://", "the network is not read",
                           "'lost'", "--model-path"}) {
    EXPECT_NE(lost.error().message.find(word), std::string::npos) << lost.error().message;
  }
}

}  // namespace
}  // namespace canopeer
