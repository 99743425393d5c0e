#include "canopeer/import/sdf/sdf_tree.h"

#include <gtest/gtest.h>

#include "canopeer/import/sdf/sdf_world.h"
#include "world_files.h"

// What stands where is compared with libsdformat in sdf_oracle_test.cpp, where there is one.

namespace canopeer {
namespace {

SdfWorld read(const test::WorldFiles& files, const std::string& content,
              const std::string& version = "1.9") {
  auto world = read_sdf_world(files.add_world(content, version), ModelPaths({files.models()}));
  EXPECT_TRUE(world.has_value()) << world.error().message;
  return world.value_or(SdfWorld{});
}

std::string error_of(const test::WorldFiles& files, const std::string& content) {
  const auto world = read_sdf_world(files.add_world(content, "1.9"), ModelPaths({files.models()}));
  return world ? "" : world.error().message;
}

void expect_in(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
  }
}

std::vector<Vec3> places(const SdfWorld& world) {
  std::vector<Vec3> all;
  for (const SdfVisual& v : world.visuals) all.push_back(v.T_world_visual.translation());
  return all;
}

std::string model(const std::string& name, const std::string& more) {
  return "<model name='" + name + "'>" + more + "<link name='l'>" + test::box_visual("1 1 1") +
         "</link></model>";
}

TEST(SdfTree, PosesAreRelativeToWhatTheyName) {
  const test::WorldFiles files;
  const SdfWorld world = read(
      files, "<frame name='late'><pose relative_to='row::end'>0 0 4 0 0 0</pose></frame>" +
                 model("a", "<pose relative_to='late'>0.5 0 0 0 0 0</pose>") +
                 "<model name='row'><pose degrees='true'>10 0 0 0 0 90</pose><frame name='end' "
                 "attached_to='l'><pose>2 0 0 0 0 0</pose></frame><link name='l'><pose "
                 "relative_to='__model__'>1 0 0 0 0 0</pose>" +
                 test::box_visual("1 1 1", "<pose relative_to='end'>0 0 1 0 0 0</pose>") +
                 "</link></model>" + model("b", "<pose relative_to='world'>7 0 0 0 0 0</pose>"));
  const std::vector<Vec3> at = places(world);
  ASSERT_EQ(at.size(), 3U);
  EXPECT_LT((at[0] - Vec3(10, 3.5, 4)).norm(), 1e-12) << at[0].transpose();
  EXPECT_LT((at[1] - Vec3(10, 3, 1)).norm(), 1e-12) << at[1].transpose();
  EXPECT_EQ(at[2], Vec3(7, 0, 0));
}

TEST(SdfTree, APlacementFrameIsPutWhereThePoseSays) {
  const test::WorldFiles files;
  files.add_model("pot", "<pose>0 0 3 0 0 0</pose>" + test::box_visual("1 1 1"));
  const SdfWorld world =
      read(files,
           "<include><uri>model://pot</uri><placement_frame>link</placement_frame>"
           "<pose>1 2 0 0 0 0</pose></include>");
  EXPECT_EQ(places(world), std::vector<Vec3>{Vec3(1, 2, 0)});
  expect_in(error_of(files,
                     "<include><uri>model://pot</uri><placement_frame>link"
                     "</placement_frame></include>"),
            {"world.world:4: <placement_frame>: expected a <pose>"});
  expect_in(error_of(files,
                     "<include><uri>model://pot</uri><placement_frame>lid"
                     "</placement_frame><pose>0 0 0 0 0 0</pose></include>"),
            {"world.world:4: <include>", "'lid' is no link", "of model 'pot'"});
}

TEST(SdfTree, AMergedModelIsPartOfItsParent) {
  const test::WorldFiles files;
  files.add_model("pot", test::box_visual("1 1 1"));
  const std::string pot = "<uri>model://pot</uri><pose>0 0 1 0 0 0</pose></include>";
  const SdfWorld world =
      read(files, "<model name='row'><pose>1 0 0 0 0 0</pose><include merge='true'>" + pot +
                      "<frame name='f'><pose relative_to='_merged__pot__model__'>0 5 0 0 0 "
                      "0</pose></frame><link name='l'><pose relative_to='f'/>" +
                      test::box_visual("1 1 1") + "</link></model><include merge='true'>" + pot);
  ASSERT_EQ(world.visuals.size(), 3U);
  EXPECT_EQ(world.visuals[0].names.model, "pot");  // the world has no links
  EXPECT_EQ(world.visuals[1].names.model, "row");
  EXPECT_EQ(world.visuals[1].names.link, "link");
  EXPECT_EQ(places(world), (std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {1, 5, 1}}));
}

TEST(SdfTree, APopulationIsPlacedAndSaid) {
  const test::WorldFiles files;
  files.add_model("pepper", test::box_visual("1 1 1"));
  const std::string grid =
      "<pose degrees='true'>10 0 0 0 0 90</pose><distribution><type>grid</type><rows>1</rows>"
      "<cols>2</cols><step>2 0 0</step></distribution></population>";
  const SdfWorld world = read(
      files, "<population name='row'>" + model("plant", "<pose>0 0 1 0 0 0</pose>") + grid +
                 "<population name='other'><include><uri>model://pepper</uri></include>" + grid);
  ASSERT_EQ(world.visuals.size(), 4U);
  EXPECT_EQ(world.visuals[0].names.model, "plant_clone_0");
  EXPECT_EQ(world.visuals[3].names.model, "pepper_clone_1");
  EXPECT_LT((places(world)[0] - Vec3(10, -1, 1)).norm(), 1e-12);
  EXPECT_LT((places(world)[1] - Vec3(10, 1, 1)).norm(), 1e-12);
  ASSERT_EQ(world.notices.size(), 2U);
  expect_in(world.notices[0], {"world.world:4: <population> 'row': 2 models 'plant' are placed"});
  expect_in(error_of(files, "<population name='row'>" + grid), {"world.world:4", "a <model>"});
}

TEST(SdfTree, WhatHasNoShapeNeverRefusesAWorld) {
  const test::WorldFiles files;
  files.add("models/robot/model.config", "<model><sdf version='1.6'>robot.urdf</sdf></model>");
  files.add("models/robot/robot.urdf", "<robot name='ur5e'><link name='base'/></robot>");
  files.add("models/lamp/model.config", "<model><sdf version='1.6'>model.sdf</sdf></model>");
  files.add("models/lamp/model.sdf", "<sdf version='1.6'><light name='lamp'/></sdf>");
  const SdfWorld world = read(
      files,
      "<actor name='walker'/><road name='street'/><actor name='runner'/><light name='sun'><pose>x"
      "</pose></light><plugin filename='x' name='y'><model/></plugin><physics/><gz:system/><joint "
      "name='j'/><include><uri>model://robot</uri></include><include><uri>model://lamp</uri>"
      "</include><model name='m'><plugin/><unheard_of/><link name='l'><sensor "
      "name='s'><camera/></sensor><inertial><mass>none</mass></inertial>" +
          test::box_visual("1 1 1") +
          "<visual name='bare'/><visual name='e'><geometry><empty/></geometry></visual>"
          "<visual name='h'><geometry><heightmap/></geometry></visual></link></model>");
  EXPECT_EQ(world.visuals.size(), 1U);
  ASSERT_EQ(world.notices.size(), 4U);
  expect_in(world.notices[0], {"robot.urdf is URDF and is left out", "comes from the mission"});
  EXPECT_EQ(world.notices[1], "2 <actor> left out: walker, runner");
  EXPECT_EQ(world.notices[2], "1 <road> left out: street");
  expect_in(world.notices[3], {"<heightmap>", "left out"});
}

TEST(SdfTree, ANewerVersionIsReadAndSaid) {
  const test::WorldFiles files;
  const SdfWorld world = read(files, model("m", ""), "1.13");
  EXPECT_EQ(world.visuals.size(), 1U);
  ASSERT_EQ(world.notices.size(), 1U);
  expect_in(world.notices[0], {"world.world:2: SDF 1.13 is newer", "read as 1.12"});
}

TEST(SdfTree, CirclesAndWhatIsNowhereAreErrors) {
  const test::WorldFiles files;
  const auto folder = [&](const std::string& name, const std::string& other) {
    files.add("models/" + name + "/model.config",
              "<model><sdf version='1.7'>model.sdf</sdf></model>");
    files.add("models/" + name + "/model.sdf",
              "<sdf version='1.7'><model name='m'><include>\n<uri>"
              "model://" +
                  other + "</uri></include></model></sdf>");
  };
  folder("a", "b");
  folder("b", "a");
  expect_in(error_of(files, "<include><uri>model://a</uri></include>"),
            {"models/b/model.sdf:1: <include><uri>model://a", "circle", "models/a/model.sdf"});
  expect_in(error_of(files, model("m", "<pose relative_to='f'/><frame name='f'/>")),
            {"world.world:4: <model> 'm'", "'f' is no link, joint, frame or model of the world"});
  expect_in(error_of(files,
                     "<frame name='f'><pose relative_to='g'/></frame><frame name='g' "
                     "attached_to='f'/>" +
                         model("m", "<pose relative_to='g'/>")),
            {"world.world:4: <frame> 'g'", "relative to itself"});
  expect_in(error_of(files, model("m", "<link name='l'/>")), {"<link> 'l'", "no other link"});
  expect_in(error_of(files, "<include/>"), {"world.world:4: <include>: expected a <uri>"});
  files.add("robot.urdf", "<robot name='ur5e'/>");
  const auto robot = read_sdf_world(files.path() / "robot.urdf", ModelPaths({}));
  expect_in(robot.error().message, {"robot.urdf:1: expected <sdf version=…>", "found <robot>"});
}

TEST(SdfTree, WhatWouldGrowWithoutEndIsAnError) {
  const test::WorldFiles files;
  const auto chain_of = [&](int models, const std::vector<std::string>& copies) {
    for (int i = 0; i < models; ++i) {
      const std::string folder = "models/m" + std::to_string(i);
      std::string next;
      for (const std::string& copy : copies) {
        next += "<include><name>" + copy + "</name><uri>model://m" + std::to_string(i + 1) +
                "</uri></include>";
      }
      files.add(folder + "/model.config", "<model><sdf version='1.7'>model.sdf</sdf></model>");
      files.add(folder + "/model.sdf",
                "<sdf version='1.7'><model name='m'>" + next + "</model></sdf>");
    }
    files.add_model("m" + std::to_string(models), "");
    return error_of(files, "<include><uri>model://m0</uri></include>");
  };
  EXPECT_EQ(chain_of(90, {"a"}), "");
  expect_in(chain_of(110, {"a"}), {"m99/model.sdf:1: <model> 'a'", "more than 100 deep"});
  expect_in(chain_of(30, {"a", "b"}), {"at most 50000 models"});
  std::string chain = "<frame name='f0'/>";
  for (int i = 1; i < 3000; ++i) {
    chain +=
        "<frame name='f" + std::to_string(i) + "' attached_to='f" + std::to_string(i - 1) + "'/>";
  }
  expect_in(error_of(files, chain + model("m", "<pose relative_to='f2999'/>")),
            {"more than 1000 others hang on each other"});
}

}  // namespace
}  // namespace canopeer
