#include "canopeer/import/world_import.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/import/meshes/texture_file.h"
#include "mesh_writers.h"
#include "world_files.h"

namespace canopeer {
namespace {

using test::Painted;

const Vec3 kRed(0.05, 0.0, 0.5);
const Vec3 kGreen(-0.05, 0.1, 0.7);

/// A plant of four materials with two fruits, in the style given.
void add_plant(const test::WorldFiles& files, const std::string& name,
               const test::DaeStyle& style) {
  const std::vector<Painted> surfaces = {
      {"fruit_red", test::ball(kRed, 0.04), {204, 41, 9}, ""},
      {"fruit_green", test::ball(kGreen, 0.03), {162, 154, 35}, ""},
      {"leaf_mat", test::sheet(Vec3(-0.2, -0.1, 0.6), Vec3(0.2, 0.1, 0.6)), {60, 83, 22}, ""},
      {"bark", test::sheet(Vec3(-0.01, -0.01, 0.1), Vec3(0.01, 0.01, 0.1)), {101, 118, 40}, ""}};
  files.add("models/" + name + "/meshes/plant.dae", test::dae(surfaces, style));
  files.add_model(name, test::mesh_visual("model://" + name + "/meshes/plant.dae"));
}

WorldImportOptions options_for(const test::WorldFiles& files, const std::filesystem::path& world) {
  WorldImportOptions options;
  options.file = world;
  options.model_paths = {files.models()};
  options.patterns = {.fruit = "fruit", .counted = "red", .leaf = "leaf"};
  return options;
}

ImportedScene import(const WorldImportOptions& options) {
  auto scene = import_world(options);
  EXPECT_TRUE(scene.has_value()) << scene.error().message;
  return scene.value_or(ImportedScene{});
}

TEST(WorldImport, FruitsLieWhereTheWorldPutsThem) {
  const test::WorldFiles files;
  test::DaeStyle centimetres;
  centimetres.unit_m = 0.01;
  centimetres.outer.translate(Vec3(40, 0, 100));
  test::DaeStyle lying;
  lying.unit_m = 0.0254;
  lying.up = UpAxis::y;
  lying.node.scale(0.5);
  add_plant(files, "a", centimetres);
  add_plant(files, "b", lying);
  const auto world = files.add_world(
      "<include><uri>model://a</uri><name>first</name><pose>1 2 0 0 0 1.5707963267948966</pose>"
      "</include><include><uri>model://b</uri><name>second</name><pose>-1 0 0 0 0 "
      "0</pose></include>"
      "<state world_name=\"test\"><model name=\"second\"><pose>-2 0 0.5 0 0 0</pose></model>"
      "</state>");
  const ImportedScene imported = import(options_for(files, world));
  const Scene& scene = imported.scene;
  ASSERT_EQ(scene.fruits.size(), 4U);
  EXPECT_EQ(scene.counted_fruits(), 2);
  const auto expect_fruit = [&](const std::string& model, bool counted, const Vec3& centre,
                                double radius) {
    const auto found = std::find_if(scene.fruits.begin(), scene.fruits.end(), [&](const auto& f) {
      return f.model == model && f.counted == counted;
    });
    ASSERT_NE(found, scene.fruits.end()) << model;
    EXPECT_LT((found->centre - centre).norm(), 1e-5) << found->centre.transpose();
    EXPECT_NEAR(found->volume_cm3, test::volume_cm3(test::ball(Vec3(0, 0, 0), radius)), 0.01);
    EXPECT_NEAR(found->surface_cm2, test::ball(Vec3(0, 0, 0), radius).area() * 1e4, 0.01);
    EXPECT_NEAR(found->length_m, 2.0 * radius, 1e-5);
    EXPECT_NEAR(found->diameter_m, 2.0 * radius, 1e-3 * radius + 1e-5);
  };
  const auto turned = [](const Vec3& p) { return Vec3(-p.y() + 1.0, p.x() + 2.0, p.z()); };
  expect_fruit("first", true, turned(kRed), 0.04);
  expect_fruit("first", false, turned(kGreen), 0.03);
  expect_fruit("second", true, kRed + Vec3(-2, 0, 0.5), 0.04);
  expect_fruit("second", false, kGreen + Vec3(-2, 0, 0.5), 0.03);
  // Two plants, with all their parts around them.
  Box second;
  for (const ScenePart& part : scene.parts) {
    EXPECT_GE(part.plant, 0);
    if (part.plant == 1) second.extend(part.mesh.bounds());
  }
  EXPECT_LT((second.min() - Vec3(-2.2, -0.1, 0.6)).norm(), 1e-5) << second.min().transpose();
  EXPECT_LT((second.max() - Vec3(-1.8, 0.13, 1.23)).norm(), 1e-5) << second.max().transpose();
}

TEST(WorldImport, PatternsDecideWhatIsWhat) {
  const test::WorldFiles files;
  add_plant(files, "plant", {});
  const std::string bench =
      "<model name=\"bench\"><link name=\"l\">" + test::box_visual("1 1 1") + "</link></model>";
  auto options =
      options_for(files, files.add_world("<include><uri>model://plant</uri></include>" + bench));
  const auto kinds = [&] {
    std::map<PartClass, int> count;
    for (const ScenePart& part : import(options).scene.parts) ++count[part.kind];
    return count;
  };
  using Kinds = std::map<PartClass, int>;
  EXPECT_EQ(kinds(), (Kinds{{PartClass::fruit, 2},
                            {PartClass::leaf, 1},
                            {PartClass::stem, 1},
                            {PartClass::structure, 1}}));
  options.patterns.stem = "twig";  // bark is neither: a thing beside the plant
  EXPECT_EQ(kinds(),
            (Kinds{{PartClass::fruit, 2}, {PartClass::leaf, 1}, {PartClass::structure, 2}}));
  options.patterns.skip = "bench|bark";
  EXPECT_EQ(kinds(), (Kinds{{PartClass::fruit, 2}, {PartClass::leaf, 1}}));
  options.patterns = {.fruit = "^plant$"};  // the model: all of it
  EXPECT_EQ(kinds(),
            (Kinds{{PartClass::fruit, 2}, {PartClass::distractor, 2}, {PartClass::structure, 1}}));
}

TEST(WorldImport, AScaledMeshIsScaled) {
  const test::WorldFiles files;
  files.add("ball.stl", test::binary_stl(test::ball(Vec3(0.1, 0, 0), 0.03)));
  const auto world =
      files.add_world("<model name=\"fruit_1\"><pose>0 0 1 0 0 0</pose><link name=\"l\">" +
                      test::mesh_visual("ball.stl", "<scale>1 1 -2</scale>") + "</link></model>");
  const ImportedScene imported = import(options_for(files, world));
  ASSERT_EQ(imported.scene.fruits.size(), 1U);
  const FruitTruth& fruit = imported.scene.fruits[0];
  EXPECT_LT((fruit.centre - Vec3(0.1, 0, 1)).norm(), 1e-6);
  EXPECT_NEAR(fruit.length_m, 0.12, 1e-6);
  EXPECT_NEAR(fruit.diameter_m, 0.06, 1e-4);
  // Mirrored, and still with its outside outside.
  EXPECT_GT(imported.scene.parts[0].mesh.volume(), 0.0);
}

TEST(WorldImport, TexturesAreFoundAndCut) {
  const test::WorldFiles files;
  Texture leaf;
  leaf.name = "leaf.png";
  leaf.color = ColorImage(2, 1, {30, 90, 20});
  leaf.opacity = Image<std::uint8_t>(2, 1, 255);
  leaf.opacity.at(1, 0) = 0;
  files.add("models/p/materials/textures/leaf.png", *encode_texture(leaf));
  files.add("models/p/meshes/p.dae",
            test::dae({{"m", test::sheet(Vec3(0, 0, 0), Vec3(1, 1, 0)), {1, 2, 3}, "leaf.png"}}));
  files.add_model("p", test::mesh_visual("meshes/p.dae"));
  auto options = options_for(files, files.add_world("<include><uri>model://p</uri></include>"));
  const ImportedScene imported = import(options);
  ASSERT_EQ(imported.scene.parts.size(), 1U);
  const ScenePart& part = imported.scene.parts[0];
  EXPECT_EQ(part.kind, PartClass::leaf);  // by the texture's name
  ASSERT_NE(part.texture, nullptr);
  EXPECT_TRUE(part.texture->cuts());
  EXPECT_EQ(part.uv.size(), part.mesh.vertices.size());
}

TEST(WorldImport, ThinDoubleShellsStayApart) {
  // Leaves are two sheets 1 mm apart; of two fruits as near to each other none swallows the other.
  const test::WorldFiles files;
  const double gap = 0.001;
  files.add("p.dae", test::dae({{"leaf_top", test::sheet(Vec3(0, 0, gap), Vec3(1, 1, gap)), {}, ""},
                                {"leaf_bottom", test::sheet(Vec3(0, 0, 0), Vec3(1, 1, 0)), {}, ""},
                                {"fruit_a", test::ball(Vec3(0, 0, 1), 0.04), {}, ""},
                                {"fruit_b", test::ball(Vec3(0.08 + gap, 0, 1), 0.04), {}, ""}}));
  const auto world = files.add_world("<model name=\"p\"><link name=\"l\">" +
                                     test::mesh_visual("p.dae") + "</link></model>");
  const ImportedScene imported = import(options_for(files, world));
  EXPECT_EQ(imported.scene.fruits.size(), 2U);
  std::vector<double> heights;
  for (const ScenePart& part : imported.scene.parts) {
    if (part.kind != PartClass::leaf) continue;
    EXPECT_EQ(part.mesh.triangles.size(), 2U);
    heights.push_back(part.mesh.bounds().max().z());
  }
  std::sort(heights.begin(), heights.end());
  ASSERT_EQ(heights.size(), 2U);
  EXPECT_NEAR(heights[1] - heights[0], gap, 1e-7);
}

TEST(WorldImport, WithoutATextureItGoesOnWithoutAMeshNot) {
  const test::WorldFiles files;
  files.add("models/p/meshes/p.dae",
            test::dae({{"fruit", test::ball(Vec3(0, 0, 0), 0.04), {1, 2, 3}, "lost.png"}}));
  files.add_model("p", test::mesh_visual("meshes/p.dae"));
  auto options = options_for(
      files, files.add_world("<include><uri>model://p</uri><name>one</name></include>"
                             "<include><uri>model://p</uri><name>two</name></include>"));
  const ImportedScene imported = import(options);
  EXPECT_EQ(imported.scene.fruits.size(), 2U);
  const auto about_texture =
      std::count_if(imported.notices.begin(), imported.notices.end(),
                    [](const std::string& n) { return n.find("lost.png") != std::string::npos; });
  EXPECT_EQ(about_texture, 1);  // said once, though the mesh stands there twice
  std::filesystem::remove(files.models() / "p/meshes/p.dae");
  const auto failed = import_world(options);
  ASSERT_FALSE(failed.has_value());
  EXPECT_NE(failed.error().message.find("meshes/p.dae"), std::string::npos);
  EXPECT_NE(failed.error().message.find("model.sdf"), std::string::npos);
}

TEST(WorldImport, ABrokenMeshSaysWhoRefersToIt) {
  const test::WorldFiles files;
  files.add("models/p/meshes/p.dae", "<COLLADA><asset><unit meter=\"zero\"/></asset></COLLADA>");
  files.add_model("p", test::mesh_visual("meshes/p.dae"));
  const auto failed =
      import_world(options_for(files, files.add_world("<include><uri>model://p</uri></include>")));
  ASSERT_FALSE(failed.has_value());
  for (const std::string word : {"p.dae:1", "<unit", "expected", "model.sdf:5", "model 'p'"}) {
    EXPECT_NE(failed.error().message.find(word), std::string::npos) << failed.error().message;
  }
}

TEST(WorldImport, APatternThatMatchesNothingIsToldTheNames) {
  const test::WorldFiles files;
  add_plant(files, "plant", {});
  auto options = options_for(files, files.add_world("<include><uri>model://plant</uri></include>"));
  options.patterns.fruit = "tomato";
  const ImportedScene imported = import(options);
  ASSERT_FALSE(imported.notices.empty());
  EXPECT_NE(imported.notices.back().find("'tomato'"), std::string::npos);
  EXPECT_NE(imported.notices.back().find("fruit_red"), std::string::npos);
  EXPECT_NE(parts_csv(imported).find("fruit_red,,plant_mesh,inner,plant.dae,visual,plant,"),
            std::string::npos)
      << parts_csv(imported);
}

TEST(WorldImport, WhatCannotBeRightIsSaid) {
  const test::WorldFiles files;
  add_plant(files, "a", {});
  const std::string include = "<include><uri>model://a</uri><name>plant</name>";
  auto options =
      options_for(files, files.add_world(include + "<pose>1e9 0 0 0 0 0</pose></include>"));
  const auto far = import_world(options);
  ASSERT_FALSE(far.has_value());
  EXPECT_NE(far.error().message.find("model 'plant'"), std::string::npos) << far.error().message;
  EXPECT_NE(far.error().message.find("1000000 km"), std::string::npos) << far.error().message;

  options.file = files.add_world("");
  const auto empty = import_world(options);
  ASSERT_FALSE(empty.has_value());
  EXPECT_NE(empty.error().message.find("shows nothing"), std::string::npos);

  options.file = files.add_world(include + "</include>");
  options.patterns.skip = "plant";
  const auto skipped = import_world(options);
  ASSERT_FALSE(skipped.has_value());
  EXPECT_NE(skipped.error().message.find("'plant', matches all"), std::string::npos)
      << skipped.error().message;

  options.model_paths = {files.path() / "elsewhere"};
  const auto nowhere = import_world(options);
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_NE(nowhere.error().message.find("elsewhere: no such folder"), std::string::npos);

  options.model_paths = {files.models()};
  options.patterns.skip.clear();
  options.patterns.fruit = "leaf|fruit|bark";
  options.file =
      files.add_world(include +
                      "</include><state world_name=\"test\"><model name=\"plant\"><pose>0 0 0 0 0 0"
                      "</pose><scale>100 100 100</scale></model></state>");
  const ImportedScene giant = import(options);
  ASSERT_FALSE(giant.notices.empty());
  EXPECT_NE(giant.notices.back().find("8.0 m long"), std::string::npos) << giant.notices.back();
}

TEST(WorldImport, ALoneMeshIsAWorldOfModels) {
  const test::WorldFiles files;
  WorldImportOptions options;
  options.file = files.add(
      "plant.dae", test::dae({{"fruit", test::ball(Vec3(0, 0, 1), 0.04), {200, 20, 9}, ""}}));
  options.patterns.fruit = "fruit";
  const ImportedScene imported = import(options);
  ASSERT_EQ(imported.scene.fruits.size(), 1U);
  EXPECT_EQ(imported.scene.fruits[0].model, "outer");
}

TEST(WorldImport, TellsHowFarItIs) {
  const test::WorldFiles files;
  add_plant(files, "plant", {});
  std::vector<ImportProgress> calls;
  const auto scene = import_world(
      options_for(files,
                  files.add_world("<include><uri>model://plant</uri><name>a</name></include>"
                                  "<include><uri>model://plant</uri><name>b</name></include>")),
      [&](const ImportProgress& p) { calls.push_back(p); });
  ASSERT_TRUE(scene.has_value());
  ASSERT_EQ(calls.size(), 2U);
  EXPECT_EQ(calls[1].done, calls[1].total);
  EXPECT_EQ(calls[1].triangles, scene->scene.triangle_count());
}

}  // namespace
}  // namespace canopeer
