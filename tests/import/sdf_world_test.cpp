#include "canopeer/import/sdf/sdf_world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_writers.h"
#include "world_files.h"

namespace canopeer {
namespace {

SdfWorld read(const test::WorldFiles& files, const std::filesystem::path& world) {
  auto result = read_sdf_world(world, ModelPaths({files.models()}));
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result.value_or(SdfWorld{});
}

std::string error_of(const test::WorldFiles& files, const std::filesystem::path& world) {
  const auto result = read_sdf_world(world, ModelPaths({files.models()}));
  return result ? "" : result.error().message;
}

Vec3 place_of(const SdfWorld& world, const std::string& model) {
  for (const SdfVisual& visual : world.visuals) {
    if (visual.names.model == model) return visual.T_world_visual.translation();
  }
  ADD_FAILURE() << "no model " << model;
  return Vec3::Zero();
}

std::string model(const std::string& name, const std::string& pose, const std::string& visual) {
  return "<model name=\"" + name + "\"><static>true</static><pose>" + pose +
         "</pose><link name=\"link\">" + visual + "</link></model>";
}

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT((a - b).norm(), 1e-9) << a.transpose(); }

TEST(SdfWorld, EveryVersionFrom14To112IsRead) {
  for (const std::string version :
       {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12"}) {
    const test::WorldFiles files;
    const auto path =
        files.add_world(model("box", "1 2 3 0 0 0", test::box_visual("1 1 1")), version);
    const SdfWorld world = read(files, path);
    ASSERT_EQ(world.visuals.size(), 1U) << version;
    expect_near(place_of(world, "box"), Vec3(1, 2, 3));
    EXPECT_EQ(world.name, "test");
    EXPECT_TRUE(world.notices.empty()) << world.notices[0];
  }
}

TEST(SdfWorld, StateComesBeforeTheModelsOwnPose) {
  const test::WorldFiles files;
  const std::string models = model("moved", "1 1 1 0 0 0", test::box_visual("1 1 1")) +
                             model("kept", "2 2 2 0 0 0", test::box_visual("1 1 1"));
  const auto path = files.add_world(
      models +
      "<state world_name=\"test\"><model name=\"moved\"><pose>5 6 7 0 0 1.5707963267948966</pose>"
      "</model></state>");
  const SdfWorld world = read(files, path);
  expect_near(place_of(world, "moved"), Vec3(5, 6, 7));
  expect_near(place_of(world, "kept"), Vec3(2, 2, 2));
  // Turned, too: its x points along y.
  for (const SdfVisual& v : world.visuals) {
    if (v.names.model == "moved") expect_near(v.T_world_visual.linear().col(0), Vec3(0, 1, 0));
  }
}

TEST(SdfWorld, StateHoldsPosesOfLinksAndNestedModelsInTheWorldFrame) {
  const test::WorldFiles files;
  const auto path =
      files.add_world("<model name=\"row\"><pose>1 0 0 0 0 0</pose>" +
                          model("plant", "0 1 0 0 0 0", test::box_visual("1 1 1")) +
                          model("other", "0 2 0 0 0 0", test::box_visual("1 1 1")) +
                          "<link name=\"base\">" + test::box_visual("1 1 1") + "</link></model>" +
                          "<state world_name=\"test\"><model name=\"row\"><pose>10 0 0 0 0 0</pose>"
                          "<link name=\"base\"><pose>10 0 9 0 0 0</pose></link>"
                          "<model name=\"plant\"><pose>20 1 0 0 0 0</pose></model></model></state>",
                      "1.7");
  const SdfWorld world = read(files, path);
  expect_near(place_of(world, "row"), Vec3(10, 0, 9));
  expect_near(place_of(world, "row::plant"), Vec3(20, 1, 0));
  expect_near(place_of(world, "row::other"), Vec3(10, 2, 0));  // follows its row
}

TEST(SdfWorld, StateScalesAndDeletes) {
  const test::WorldFiles files;
  const auto path = files.add_world(
      model("big", "1 0 0 0 0 0", test::box_visual("1 1 1", "<pose>0.5 0 0 0 0 0</pose>")) +
      model("gone", "2 2 2 0 0 0", test::box_visual("1 1 1")) +
      "<state world_name=\"test\"><deletions><name>gone</name></deletions><model name=\"big\">"
      "<pose>1 0 0 0 0 0</pose><scale>2 3 4</scale></model></state>");
  const SdfWorld world = read(files, path);
  ASSERT_EQ(world.visuals.size(), 1U);
  const Eigen::Affine3d& T = world.visuals[0].T_world_visual;
  expect_near(T.translation(), Vec3(2, 0, 0));
  expect_near(T.linear().diagonal(), Vec3(2, 3, 4));
}

TEST(SdfWorld, ModelsInsertedIntoARunningWorldAreThere) {
  const test::WorldFiles files;
  files.add("ball.stl", test::binary_stl(test::ball(Vec3(0, 0, 0), 0.04)));
  const auto path = files.add_world(
      model("first", "1 0 0 0 0 0", test::box_visual("1 1 1")) +
      "<state world_name=\"test\"><insertions>" +
      model("second", "2 0 0 0 0 0", test::mesh_visual("ball.stl")) +
      model("third", "3 0 0 0 0 0", test::box_visual("1 1 1")) +
      "</insertions><model name=\"third\"><pose>3 3 3 0 0 0</pose></model></state>");
  const SdfWorld world = read(files, path);
  ASSERT_EQ(world.visuals.size(), 3U);
  EXPECT_TRUE(world.notices.empty());
  expect_near(place_of(world, "second"), Vec3(2, 0, 0));
  expect_near(place_of(world, "third"), Vec3(3, 3, 3));
  EXPECT_EQ(world.visuals[1].mesh, files.path() / "ball.stl");
}

TEST(SdfWorld, APolylineIsExtruded) {
  const test::WorldFiles files;
  const std::string line =
      "<polyline><point>0 0</point><point>2 0</point><point>2 1</point><point>1 1</point>"
      "<point>1 3</point><point>0 3</point><height>0.5</height></polyline>";
  const auto one = files.add_world(model(
      "wall", "0 0 0 0 0 0", "<visual name=\"v\"><geometry>" + line + "</geometry></visual>"));
  const SdfWorld world = read(files, one);
  ASSERT_EQ(world.visuals.size(), 1U);
  EXPECT_NEAR(world.visuals[0].primitive.volume(), 2.0, 1e-6);
  const auto two = files.add_world(
      model("wall", "0 0 0 0 0 0",
            "<visual name=\"v\"><geometry>" + line + line + "</geometry></visual>"));
  const SdfWorld hollow = read(files, two);
  EXPECT_TRUE(hollow.visuals.empty());
  ASSERT_EQ(hollow.notices.size(), 1U);
  for (const char* word : {"world.world:", "<polyline>", "'wall'", "left out"}) {
    EXPECT_NE(hollow.notices[0].find(word), std::string::npos) << hollow.notices[0];
  }
}

TEST(SdfWorld, NestedModelsAndPosesRelativeToFramesResolve) {
  const test::WorldFiles files;
  const auto path = files.add_world(
      "<frame name=\"bench\"><pose>0 0 1 0 0 0</pose></frame>"
      "<model name=\"pot\"><pose relative_to=\"bench\">1 0 0 0 0 0</pose><link name=\"link\">" +
          test::box_visual("1 1 1") + "</link>" +
          model("plant", "0 0 0.5 0 0 0",
                test::box_visual("1 1 1", "<pose>0 0 0.25 0 0 0</pose>")) +
          "</model>",
      "1.8");
  const SdfWorld world = read(files, path);
  expect_near(place_of(world, "pot"), Vec3(1, 0, 1));
  expect_near(place_of(world, "pot::plant"), Vec3(1, 0, 1.75));
}

TEST(SdfWorld, IncludesAreFoundUnderTheModelPathAndBesideTheFile) {
  const test::WorldFiles files;
  files.add_model("plant", test::box_visual("1 1 1"));
  files.add_model("own", test::box_visual("1 1 1"), "beside");
  files.add("models/plant/parts/seed.txt", "x");
  const auto path = files.add_world(
      "<include><uri>model://plant</uri><name>a</name><pose>1 0 0 0 0 0</pose></include>"
      "<include><uri>model://plant</uri><name>b</name><pose>2 0 0 0 0 0</pose></include>"
      "<include><uri>beside/own</uri><pose>3 0 0 0 0 0</pose></include>");
  const SdfWorld world = read(files, path);
  expect_near(place_of(world, "a"), Vec3(1, 0, 0));
  expect_near(place_of(world, "b"), Vec3(2, 0, 0));
  expect_near(place_of(world, "own"), Vec3(3, 0, 0));
}

TEST(SdfWorld, TheWorkingDirectoryDoesNotMatter) {
  const test::WorldFiles files;
  files.add_model("own", test::box_visual("1 1 1"), "beside");
  files.add_model("own", test::box_visual("9 9 9"), "elsewhere/beside");
  const auto path = files.add_world("<include><uri>beside/own</uri></include>");
  const auto home = std::filesystem::current_path();
  std::filesystem::current_path(files.path() / "elsewhere");
  const SdfWorld world = read(files, path);
  std::filesystem::current_path(home);
  ASSERT_EQ(world.visuals.size(), 1U);
  expect_near(world.visuals[0].primitive.bounds().sizes(), Vec3(1, 1, 1));
}

TEST(SdfWorld, AnIncludedModelMayIncludeItsNeighbour) {
  const test::WorldFiles files;
  files.add_model("leaf", test::box_visual("1 1 1"), "models/plant/parts");
  files.add("models/plant/model.config",
            "<?xml version=\"1.0\"?><model><name>plant</name><sdf "
            "version=\"1.7\">model.sdf</sdf></model>");
  files.add("models/plant/model.sdf",
            "<?xml version=\"1.0\"?><sdf version=\"1.7\"><model name=\"plant\"><link "
            "name=\"l\"/><include><uri>parts/leaf</uri><pose>0 0 1 0 0 0</pose></include>"
            "</model></sdf>");
  const auto path =
      files.add_world("<include><uri>model://plant</uri><pose>1 0 0 0 0 0</pose></include>", "1.7");
  expect_near(place_of(read(files, path), "plant::leaf"), Vec3(1, 0, 1));
}

TEST(SdfWorld, IncludesNestAsDeepAsTheyLike) {
  // A world includes a row by scheme, that a bay beside it, that a plant by scheme again, that a
  // leaf beside it; two rows, so that each finds its own way back.
  const test::WorldFiles files;
  const auto folder = [&](const std::string& name, const std::string& body) {
    files.add("models/" + name + "/model.config",
              "<model><name>m</name><sdf version=\"1.7\">model.sdf</sdf></model>");
    files.add("models/" + name + "/model.sdf",
              "<sdf version=\"1.7\"><model name=\"m\">" + body + "</model></sdf>");
  };
  const auto include = [](const std::string& uri, const std::string& name, const std::string& x) {
    return "<include><uri>" + uri + "</uri><name>" + name + "</name><pose>" + x +
           " 0 0 0 0 0</pose></include>";
  };
  for (const std::string row : {"row_a", "row_b"}) {
    folder(row, include("bay", "bay", "1"));
    folder(row + "/bay",
           include("model://plant", "plant", "10") + include("bay_box", "own", "0.5"));
    folder(row + "/bay/bay_box", "<link name=\"l\">" + test::box_visual("1 1 1") + "</link>");
  }
  folder("plant", include("leaf", "leaf", "100"));
  folder("plant/leaf", "<link name=\"l\">" + test::box_visual("1 1 1") + "</link>");
  const auto path = files.add_world(
      include("model://row_a", "a", "1000") + include("model://row_b", "b", "2000"), "1.7");
  const SdfWorld world = read(files, path);
  ASSERT_EQ(world.visuals.size(), 4U);
  expect_near(place_of(world, "a::bay::plant::leaf"), Vec3(1111, 0, 0));
  expect_near(place_of(world, "b::bay::plant::leaf"), Vec3(2111, 0, 0));
  expect_near(place_of(world, "a::bay::own"), Vec3(1001.5, 0, 0));
  for (const SdfVisual& v : world.visuals) {
    if (v.names.model != "b::bay::own") continue;
    EXPECT_NE(v.where.find("row_b/bay/bay_box"), std::string::npos) << v.where;
  }
}

TEST(SdfWorld, MeshesAreFoundFromTheFileThatNamesThem) {
  const test::WorldFiles files;
  const auto ball = test::binary_stl(test::ball(Vec3(0, 0, 0), 0.1));
  files.add("models/plant/meshes/a.stl", ball);
  files.add("b.stl", ball);
  files.add_model("plant", test::mesh_visual("meshes/a.stl", "<scale>1 2 3</scale>"));
  const auto path = files.add_world(
      "<include><uri>model://plant</uri></include>" +
      model("near", "0 0 0 0 0 0", test::mesh_visual("b.stl")) +
      model("named", "0 0 0 0 0 0", test::mesh_visual("model://plant/meshes/a.stl")));
  const SdfWorld world = read(files, path);
  ASSERT_EQ(world.visuals.size(), 3U);
  for (const SdfVisual& v : world.visuals) {
    EXPECT_TRUE(std::filesystem::exists(v.mesh));
    if (v.names.model == "plant") {
      expect_near(v.T_world_visual.linear().diagonal(), Vec3(1, 2, 3));
    }
  }
}

TEST(SdfWorld, PrimitivesHaveTheirSizes) {
  const test::WorldFiles files;
  const auto shape = [](const std::string& geometry) {
    return "<visual name=\"v\"><geometry>" + geometry + "</geometry></visual>";
  };
  const auto path = files.add_world(
      model("box", "0 0 0 0 0 0", shape("<box><size>1 2 3</size></box>")) +
          model("ball", "0 0 0 0 0 0", shape("<sphere><radius>0.5</radius></sphere>")) +
          model("pipe", "0 0 0 0 0 0",
                shape("<cylinder><radius>0.5</radius><length>3</length></cylinder>")) +
          model("pill", "0 0 0 0 0 0",
                shape("<capsule><radius>0.5</radius><length>2</length></capsule>")) +
          model("egg", "0 0 0 0 0 0", shape("<ellipsoid><radii>1 2 3</radii></ellipsoid>")) +
          model("wall", "0 0 0 0 0 0",
                shape("<plane><normal>1 0 0</normal><size>4 4</size></plane>")),
      "1.9");
  const SdfWorld world = read(files, path);
  const auto size_of = [&](const std::string& name) -> Vec3 {
    for (const SdfVisual& v : world.visuals) {
      if (v.names.model == name) return v.primitive.bounds().sizes();
    }
    return Vec3::Zero();
  };
  expect_near(size_of("box"), Vec3(1, 2, 3));
  EXPECT_LT((size_of("ball") - Vec3(1, 1, 1)).norm(), 1e-6);
  EXPECT_LT((size_of("pipe") - Vec3(1, 1, 3)).norm(), 1e-6);
  EXPECT_LT((size_of("pill") - Vec3(1, 1, 3)).norm(), 1e-6);
  EXPECT_LT((size_of("egg") - Vec3(2, 4, 6)).norm(), 1e-6);
  EXPECT_LT((size_of("wall") - Vec3(0, 4, 4)).norm(), 1e-6);
  for (const SdfVisual& v : world.visuals) {
    if (v.names.model != "wall") {
      EXPECT_GT(v.primitive.volume(), 0.0) << v.names.model;
    }
  }
}

TEST(SdfWorld, MaterialsAreThoseOfTheVisual) {
  const test::WorldFiles files;
  const auto path = files.add_world(
      model("red", "0 0 0 0 0 0",
            test::box_visual("1 1 1",
                             "<material><script><uri>x</uri><name>Gazebo/Red</name>"
                             "</script></material>")) +
      model("own", "0 0 0 0 0 0",
            test::box_visual("1 1 1", "<material><diffuse>0 0.5 1 1</diffuse></material>")) +
      model("glass", "0 0 0 0 0 0", test::box_visual("1 1 1", "<transparency>0.9</transparency>")));
  for (const SdfVisual& v : read(files, path).visuals) {
    EXPECT_EQ(v.see_through, v.names.model == "glass");
    if (v.names.model == "red") {
      EXPECT_EQ(v.material.color, (Rgb{255, 0, 0}));
    }
    if (v.names.model == "own") {
      EXPECT_EQ(v.material.color, (Rgb{0, 128, 255}));
    }
    if (v.names.model == "glass") {
      EXPECT_FALSE(v.material.color.has_value());
    }
  }
}

TEST(SdfWorld, SunAndGroundPlaneNeedNotBeThere) {
  const test::WorldFiles files;
  const auto path = files.add_world(
      "<include><uri>model://sun</uri></include>"
      "<include><uri>model://ground_plane</uri></include>");
  const SdfWorld world = read(files, path);
  ASSERT_EQ(world.visuals.size(), 1U);
  EXPECT_EQ(world.visuals[0].names.model, "ground_plane");
  EXPECT_NEAR(world.visuals[0].primitive.bounds().sizes().x(), 100.0, 1e-9);
}

TEST(SdfWorld, ALoneModelIsAWorld) {
  const test::WorldFiles files;
  files.add_model("plant", test::box_visual("1 1 1"));
  const SdfWorld world = read(files, files.models() / "plant" / "model.sdf");
  ASSERT_EQ(world.visuals.size(), 1U);
  EXPECT_EQ(world.visuals[0].names.model, "plant");
}

TEST(SdfWorld, ErrorsSayFileLineAndWhatWasExpected) {
  const test::WorldFiles files;
  const auto expect = [&](const std::filesystem::path& world, std::vector<std::string> words) {
    const std::string message = error_of(files, world);
    for (const std::string& word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in: " << message;
    }
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  expect(files.path() / "no.world", {"no.world: no such file"});
  expect(files.path(), {"is a folder", "expected a .world or .sdf file"});
  expect(files.add("text.world", "hello"), {"text.world:1: is no sound XML"});
  expect(files.add("nothing.world", ""), {"nothing.world:1: is no sound XML: empty document"});
  expect(files.add("page.world", "<html/>"), {"page.world: is a web page"});
  expect(files.add("cut.world", "<sdf version=\"1.6\">\n<world name=\"w\">\n</sdf>"),
         {"cut.world:2: is no sound XML: mismatched element"});
  expect(files.add("empty.world", "<sdf version=\"1.6\"></sdf>"), {"empty.world"});
  expect(
      files.add_world("<include><uri>model://lost</uri></include>"),
      {"world.world:4: <include><uri>model://lost: no such model", "--model-path", "models/lost"});
  files.add_model("plant", test::mesh_visual("meshes/lost.dae"));
  expect(files.add_world("<include><uri>model://plant</uri><name>plant_7</name></include>"),
         {"models/plant/model.sdf:5", "<uri>meshes/lost.dae", "no such file", "plant_7",
          "models/plant/meshes/lost.dae"});
  expect(files.add_world(model("a", "0 0 0 0 0 0", "") + model("a", "0 0 0 0 0 0", "")),
         {"world.world:4: <model> 'a'", "expected a name that no other"});
  expect(files.add_world(model("box", "one two three", test::box_visual("1 1 1"))),
         {"world.world:4: <pose>", "expected six numbers", "found 'one two three'"});
  files.add("models/broken/model.config",
            "<model><name>b</name><sdf version=\"1.6\">model.sdf</sdf></model>");
  files.add("models/broken/model.sdf", "<sdf version=\"1.6\">\n<model name=\"b\">\n</sdf>");
  expect(files.add_world("<include><uri>model://broken</uri></include>"),
         {"models/broken/model.sdf:2: is no sound XML"});
}

}  // namespace
}  // namespace canopeer
