#include <gtest/gtest.h>
#include <unistd.h>

#include "field_meshes.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// A model of one box.
std::string box_model(const std::string& more = "") {
  return "<model name=\"m\">" + more + "<link name=\"l\">" + more + "<visual name=\"fruit\">" +
         more +
         "<geometry><box><size>0.08 0.08 0.08</size></box></geometry></visual></link></model>";
}

TEST(FieldWorlds, EveryNameWorksInThePresentFolder) {
  const test::WorldFiles files;
  const fs::path before = fs::current_path();
  fs::current_path(files.path());
  for (const char* name : {"model.sdf", "world.sdf", "scene.sdf", "light.sdf", "root.sdf",
                           "model.world", "actor.sdf", "plant"}) {
    files.add(name, "<sdf version=\"1.6\">" + box_model() + "</sdf>");
    const auto read = test::import_all_as_fruit(name);
    EXPECT_EQ(read.error, "") << name;
    EXPECT_EQ(read.world.scene.fruits.size(), 1U) << name;
  }
  fs::current_path(before);
}

TEST(FieldWorlds, UnknownSensorsPluginsAndElementsRefuseNothing) {
  const test::WorldFiles files;
  const std::string odd =
      "<sensor name=\"s\" type=\"smell\"><update_rate>often</update_rate></sensor>"
      "<plugin name=\"p\" filename=\"libnone.so\"><pose>nowhere</pose></plugin>"
      "<mine:own xmlns:mine=\"x\"><pose>1</pose></mine:own><battery name=\"b\"/>";
  const auto read = test::import_all_as_fruit(files.add_world(
      odd + "<physics type=\"none\"/><light name=\"l\" type=\"moon\"/>" + box_model(odd)));
  EXPECT_EQ(read.error, "");
  EXPECT_EQ(read.world.scene.fruits.size(), 1U);
}

TEST(FieldWorlds, PopulationsArePlacedAndWhatIsLeftOutIsNamedAndCounted) {
  const test::WorldFiles files;
  files.add_model("pepper", test::box_visual("0.08 0.08 0.08"));
  const auto read = test::import_all_as_fruit(
      files.add_world(
          "<population name=\"row\"><model name=\"p\"><include><uri>model://pepper</uri>"
          "</include></model><model_count>10</model_count><box><size>1 8 0.1</size></box>"
          "<distribution><type>linear-y</type></distribution></population>"
          "<actor name=\"walker\"/><actor name=\"picker\"/><road name=\"path\"/>" +
          box_model()),
      {files.models()});
  ASSERT_EQ(read.error, "");
  EXPECT_EQ(read.world.scene.fruits.size(), 11U);
  const auto says = [&](const char* words) {
    return std::any_of(read.world.notices.begin(), read.world.notices.end(),
                       [&](const auto& n) { return n.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("<population> 'row': 10 models 'p' are placed"));
  EXPECT_TRUE(says("2 <actor> left out: walker, picker"));
  EXPECT_TRUE(says("1 <road> left out: path"));
}

}  // namespace
}  // namespace canopeer
