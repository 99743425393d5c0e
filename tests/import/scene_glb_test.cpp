#include "canopeer/import/scene_glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "canopeer/import/world_import.h"
#include "canopeer/scene/worlds.h"
#include "mesh_writers.h"
#include "world_files.h"

namespace canopeer {
namespace {

ScenePart part_of(const TriangleMesh& mesh, PartClass kind, int plant, int fruit, Rgb color) {
  ScenePart part;
  part.mesh = mesh;
  compute_normals(part.mesh);
  part.kind = kind;
  part.plant = plant;
  part.fruit = fruit;
  part.color = color;
  return part;
}

/// Written as a file and imported by the names that are written.
Expected<ImportedScene> read_back(const Scene& scene) {
  const test::WorldFiles files;
  WorldImportOptions options;
  options.file = files.path() / "scene.glb";
  options.patterns = {.fruit = "^fruit", .counted = "_counted", .leaf = "^leaf"};
  return write_scene_glb(options.file, scene).and_then([&] { return import_world(options); });
}

TEST(SceneGlb, ReadsBackAsTheSameScene) {
  Scene scene;
  scene.imported = true;
  const Vec3 centre(0.3, -0.4, 0.5);
  scene.parts.push_back(part_of(test::ball(centre, 0.04), PartClass::fruit, 0, 0, {204, 41, 9}));
  ScenePart leaf =
      part_of(test::sheet(Vec3(0, 0, 0.2), Vec3(0.5, 1, 0.2)), PartClass::leaf, 0, -1, {});
  Texture texture;
  texture.name = "leaf.png";
  texture.color = ColorImage(2, 2, {10, 100, 20});
  texture.color.at(0, 1) = {99, 98, 97};  // lower left
  texture.opacity = Image<std::uint8_t>(2, 2, 255);
  texture.opacity.at(1, 0) = 0;  // upper right
  leaf.texture = std::make_shared<const Texture>(texture);
  for (const auto& v : leaf.mesh.vertices) leaf.uv.emplace_back(2.0F * v.x(), v.y());
  scene.parts.push_back(leaf);
  scene.parts.push_back(part_of(make_box(Box(Vec3(-1, -1, -0.1), Vec3(1, 1, 0))),
                                PartClass::structure, -1, -1, {124, 112, 100}));
  FruitTruth fruit;
  fruit.model = "plant_7";
  scene.fruits.push_back(fruit);

  const auto back = read_back(scene);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  ASSERT_EQ(back->scene.fruits.size(), 1U);
  EXPECT_EQ(back->scene.fruits[0].model, "plant_7");
  EXPECT_TRUE(back->scene.fruits[0].counted);
  EXPECT_LT((back->scene.fruits[0].centre - centre).norm(), 1e-6);
  EXPECT_LT((back->scene.bounds().min() - scene.bounds().min()).norm(), 1e-6);
  EXPECT_LT((back->scene.bounds().max() - scene.bounds().max()).norm(), 1e-6);
  for (const ScenePart& part : back->scene.parts) {
    if (part.kind == PartClass::fruit) {
      EXPECT_EQ(part.color, (Rgb{204, 41, 9}));
    }
    if (part.kind == PartClass::structure) {
      EXPECT_EQ(part.plant, -1);
    }
    if (part.kind != PartClass::leaf) continue;
    ASSERT_NE(part.texture, nullptr);
    EXPECT_TRUE(part.texture->cuts());
    // The corner at x = y = 0 has the lower left colour, the one opposite is a hole.
    for (std::size_t i = 0; i < part.uv.size(); ++i) {
      const auto& v = part.mesh.vertices[i];
      const Eigen::Vector2f inward = part.uv[i] + (Eigen::Vector2f(0.5F, 0.5F) - part.uv[i]) * 0.1F;
      if (v.x() < 0.1F && v.y() < 0.1F) {
        EXPECT_EQ(part.texture->color_at(inward), Eigen::Vector3f(99, 98, 97));
      }
      EXPECT_EQ(part.texture->solid_at(inward), v.x() < 0.1F || v.y() < 0.1F);
    }
  }
}

TEST(SceneGlb, AGeneratedRowKeepsItsFruits) {
  const Scene scene = make_world(scenario_1_world(), 1);
  const auto back = read_back(scene);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(back->scene.fruits.size(), scene.fruits.size());
  EXPECT_EQ(back->scene.counted_fruits(), scene.counted_fruits());
  // Every fruit has one within a millimetre, with a hull a little larger than its body.
  for (const FruitTruth& fruit : scene.fruits) {
    const auto near =
        std::find_if(back->scene.fruits.begin(), back->scene.fruits.end(),
                     [&](const FruitTruth& f) { return (f.centre - fruit.centre).norm() < 3e-3; });
    ASSERT_NE(near, back->scene.fruits.end()) << fruit.id;
    EXPECT_EQ(near->counted, fruit.counted);
    EXPECT_GT(near->volume_cm3, fruit.volume_cm3);
    EXPECT_LT(near->volume_cm3, 1.25 * fruit.volume_cm3);
  }
}

/// The JSON of a .glb and the length of its binary part, both held against the lengths the file
/// states.
struct GlbText {
  nlohmann::json json;
  std::size_t binary_bytes = 0;
};

GlbText read_glb(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  const std::string glb = bytes.str();
  const auto word = [&](std::size_t at) {
    std::uint32_t w = 0;
    if (at + 4 <= glb.size()) std::memcpy(&w, glb.data() + at, 4);
    return w;
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(8), glb.size());
  const std::size_t text = word(12);
  const std::size_t binary = word(20 + text);
  EXPECT_EQ(28 + text + binary, glb.size());
  return {nlohmann::json::parse(glb.substr(20, text), nullptr, false), binary};
}

TEST(SceneGlb, ALongRowHasEveryCopyByNameInItsPlace) {
  const Scene scene = make_world(*named_world("row_100m"), 1);
  const test::WorldFiles files;
  const auto path = files.path() / "row.glb";
  ASSERT_TRUE(write_scene_glb(path, scene).has_value());
  const auto [gltf, binary_bytes] = read_glb(path);
  ASSERT_TRUE(gltf.is_object());
  // Copies share meshes: the file is a fraction of the row.
  EXPECT_LT(binary_bytes, 40U << 20U);
  EXPECT_EQ(gltf["buffers"][0]["byteLength"], binary_bytes);
  for (const auto& view : gltf["bufferViews"]) {
    EXPECT_LE(view.value("byteOffset", std::size_t{0}) + view["byteLength"].get<std::size_t>(),
              binary_bytes);
  }
  for (const auto& accessor : gltf["accessors"]) {
    ASSERT_LT(accessor["bufferView"].get<std::size_t>(), gltf["bufferViews"].size());
  }
  std::map<std::string, std::size_t> node_of;
  for (const auto& root : gltf["scenes"][0]["nodes"]) {
    const auto node = root.get<std::size_t>();
    ASSERT_LT(node, gltf["nodes"].size());
    EXPECT_TRUE(node_of.emplace(gltf["nodes"][node]["name"], node).second) << "a name twice";
  }
  std::map<std::string, int> fruits;
  ASSERT_EQ(scene.instances.size(), 400U);
  for (const SceneInstance& copy : scene.instances) {
    const std::string name = "plant_" + std::to_string(copy.plant);
    ASSERT_TRUE(node_of.count(name)) << name;
    const auto& node = gltf["nodes"][node_of[name]];
    // y up: x, z and −y of ours, in the last column.
    const Vec3 p = copy.T_world_model.translation();
    EXPECT_NEAR(node["matrix"][12], p.x(), 1e-9);
    EXPECT_NEAR(node["matrix"][13], p.z(), 1e-9);
    EXPECT_NEAR(node["matrix"][14], -p.y(), 1e-9);
    ASSERT_EQ(node["children"].size(), scene.models[copy.model].parts.size());
    for (const auto& child : node["children"]) {
      const auto& part = gltf["nodes"][child.get<std::size_t>()];
      ASSERT_LT(part["mesh"].get<std::size_t>(), gltf["meshes"].size());
      const std::string part_name = part["name"];
      if (part_name.rfind("fruit_", 0) == 0 && part_name.rfind("fruit_part", 0) != 0) {
        ++fruits[part_name];
      }
    }
  }
  ASSERT_EQ(fruits.size(), scene.fruits.size());
  for (const FruitTruth& fruit : scene.fruits) {
    EXPECT_EQ(fruits["fruit_" + std::to_string(fruit.id)], 1) << fruit.id;
  }
}

TEST(SceneGlb, CopiesReadBackAsPlantsOfTheirOwn) {
  WorldOptions row = *named_world("row_100m");
  row.plants.resize(6);
  row.copies = 3;
  const Scene scene = make_world(row, 2);
  ASSERT_EQ(scene.instances.size(), 6U);
  const auto back = read_back(scene);
  ASSERT_TRUE(back.has_value()) << back.error().message;
  ASSERT_EQ(back->scene.fruits.size(), scene.fruits.size());
  EXPECT_EQ(back->scene.counted_fruits(), scene.counted_fruits());
  for (const FruitTruth& fruit : scene.fruits) {
    EXPECT_TRUE(
        std::any_of(back->scene.fruits.begin(), back->scene.fruits.end(),
                    [&](const FruitTruth& f) { return (f.centre - fruit.centre).norm() < 3e-3; }))
        << fruit.id;
  }
}

}  // namespace
}  // namespace canopeer
