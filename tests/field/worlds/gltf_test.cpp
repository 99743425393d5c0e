#include <gtest/gtest.h>

#include <stdexcept>

#include "canopeer/base/rng.h"
#include "canopeer/import/meshes/plain_gltf.h"
#include "field_meshes.h"

namespace canopeer {
namespace {

/// The cube as one fruit of 8 cm, whatever the file's words.
void expect_cube(const test::GltfCube& cube, const char* what) {
  const test::WorldFiles files;
  files.add("cube.bin", test::gltf_numbers_of(cube));
  const auto read = test::import_all_as_fruit(files.add("cube.gltf", test::gltf_text(cube)));
  ASSERT_EQ(read.error, "") << what;
  ASSERT_EQ(read.world.scene.fruits.size(), 1U) << what;
  const FruitTruth& fruit = read.world.scene.fruits.front();
  EXPECT_NEAR(fruit.volume_cm3, 512.0, 0.1) << what;
  EXPECT_NEAR(fruit.centre.norm(), 0.0, 1e-6) << what;
}

TEST(FieldGltf, PositionsAreWholeNumbersOrFloats) {
  test::GltfCube cube;
  expect_cube(cube, "floats");
  cube.sparse = true;
  expect_cube(cube, "floats, one apart");
  cube.sparse = false;
  cube.extra = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  for (const int component : {5120, 5122}) {
    cube.component = component;
    for (const bool normalized : {false, true}) {
      cube.normalized = normalized;
      expect_cube(cube, "whole numbers");
    }
  }
}

/// Colour of the cube, all of whose corners have one texture coordinate.
Rgb color_of(const std::string& texture, const std::string& extra = "") {
  const test::WorldFiles files;
  test::GltfCube cube;
  cube.texture = texture;
  cube.extra = extra;
  files.add("cube.bin", test::gltf_numbers_of(cube));
  files.add("four colors.bmp", test::four_colors_bmp());
  const auto read = test::import_all_as_fruit(files.add("cube.gltf", test::gltf_text(cube)));
  EXPECT_EQ(read.error, "");
  if (read.world.scene.parts.empty() || read.world.scene.parts.front().texture == nullptr) {
    return {};
  }
  const ScenePart& part = read.world.scene.parts.front();
  const Eigen::Vector3f c = part.texture->color_at(part.uv.front());
  return {static_cast<std::uint8_t>(c.x()), static_cast<std::uint8_t>(c.y()),
          static_cast<std::uint8_t>(c.z())};
}

TEST(FieldGltf, TexturesLieWhereTheirTransformPutsThem) {
  const auto moved = [](const std::string& transform) {
    return color_of(R"({"index":0,"extensions":{"KHR_texture_transform":)" + transform + "}}");
  };
  // (0.25, 0.25) from the upper left is red.
  EXPECT_EQ(color_of(R"({"index":0})"), (Rgb{255, 0, 0}));
  EXPECT_EQ(color_of(R"({"index":0,"texCoord":1})"), (Rgb{255, 255, 255}));
  EXPECT_EQ(moved(R"({"offset":[0.5,0]})"), (Rgb{0, 255, 0}));
  EXPECT_EQ(moved(R"({"offset":[0,0.5]})"), (Rgb{0, 0, 255}));
  EXPECT_EQ(moved(R"({"scale":[3,1]})"), (Rgb{0, 255, 0}));
  EXPECT_EQ(moved(R"({"texCoord":1})"), (Rgb{255, 255, 255}));
  // The specification's example: the lower left quarter, turned.
  EXPECT_EQ(moved(R"({"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]})"),
            (Rgb{0, 0, 255}));
}

TEST(FieldGltf, TheMaterialsColourTintsItsPicture) {
  const auto tinted = [](const std::string& factor) {
    return color_of(R"({"index":0,"texCoord":1},"baseColorFactor":)" + factor);  // on white
  };
  EXPECT_EQ(tinted("[1,1,1,1]"), (Rgb{255, 255, 255}));
  EXPECT_EQ(tinted("[1,0,0,1]"), (Rgb{255, 0, 0}));
  EXPECT_EQ(tinted("[0.2158605,1,1,1]"), (Rgb{128, 255, 255}));  // a share of light, no level
}

TEST(FieldGltf, PicturesOfExtensionsAreSources) {
  const test::WorldFiles files;
  test::GltfCube cube;
  cube.texture = R"({"index":0})";
  std::string text = test::gltf_text(cube);
  const std::string plain = R"("textures":[{"source":0}])";
  text.replace(text.find(plain), plain.size(),
               R"("textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}])");
  files.add("cube.bin", test::gltf_numbers_of(cube));
  files.add("four colors.bmp", test::four_colors_bmp());
  const auto read = test::import_all_as_fruit(files.add("cube.gltf", text));
  ASSERT_EQ(read.error, "");
  EXPECT_NE(read.world.scene.parts.front().texture, nullptr);
}

TEST(FieldGltf, FilesOfNumbersAreFoundByTheirEncodedName) {
  const test::WorldFiles files;
  test::GltfCube cube;
  cube.buffer_uri = "my%20cube%C3%A9.bin";
  const auto path = files.add("cube.gltf", test::gltf_text(cube));
  EXPECT_NE(test::import_all_as_fruit(path).error.find("my cubeé.bin"), std::string::npos);
  files.add("my cubeé.bin", test::gltf_numbers_of(cube));
  const auto read = test::import_all_as_fruit(path);
  ASSERT_EQ(read.error, "");
  EXPECT_EQ(read.world.scene.fruits.size(), 1U);
}

TEST(FieldGltf, BinaryFilesMayForgetToFillUpWords) {
  const test::WorldFiles files;
  test::GltfCube cube;
  std::string text = test::gltf_text(cube);
  const std::string uri = R"(,"uri":"cube.bin")";
  text.erase(text.find(uri), uri.size());
  text += std::string(5 - text.size() % 4, ' ');  // one byte more than whole words
  const auto word = [](std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&number), sizeof number);
  };
  const std::string numbers = test::gltf_numbers_of(cube);
  const std::string chunks =
      word(text.size()) + "JSON" + text + word(numbers.size()) + std::string("BIN\0", 4) + numbers;
  const auto read = test::import_all_as_fruit(
      files.add("cube.glb", "glTF" + word(2) + word(12 + chunks.size()) + chunks));
  ASSERT_EQ(read.error, "");
  EXPECT_EQ(read.world.scene.fruits.size(), 1U);
}

TEST(FieldGltf, WhatAFileNeedsAndNobodyKnowsIsRefused) {
  const test::WorldFiles files;
  for (const auto& [name, words] :
       {std::pair{"EXT_nobody_knows", "needs the glTF extension 'EXT_nobody_knows'"},
        std::pair{"KHR_draco_mesh_compression", "packs its meshes with Draco; export it without"},
        std::pair{"EXT_meshopt_compression", "packs its numbers with meshoptimizer"}}) {
    test::GltfCube cube;
    cube.extra = std::string(R"(,"extensionsRequired":[")") + name + "\"]";
    files.add("cube.bin", test::gltf_numbers_of(cube));
    const auto read = test::import_all_as_fruit(files.add("cube.gltf", test::gltf_text(cube)));
    EXPECT_NE(read.error.find(words), std::string::npos) << read.error;
  }
  for (const char* known :
       {"KHR_materials_unlit", "KHR_texture_transform", "KHR_lights_punctual"}) {
    test::GltfCube cube;
    cube.extra = std::string(R"(,"extensionsRequired":[")") + known + "\"]";
    expect_cube(cube, known);
  }
}

TEST(FieldGltf, WhatIsDamagedIsSaidInOurWords) {
  const test::WorldFiles files;
  files.add("cube.bin", test::gltf_numbers_of({}));
  const auto error = [&](const std::string& text) {
    return test::import_all_as_fruit(files.add("cube.gltf", text)).error;
  };
  EXPECT_NE(error("{\"asset\": {").find("its JSON breaks off or is damaged at byte"),
            std::string::npos);
  EXPECT_NE(error("[]").find("its JSON is no glTF"), std::string::npos);
  test::GltfCube cube;
  cube.component = 5122;
  std::string text = test::gltf_text(cube);
  text.replace(text.find("\"count\":8"), 9, "\"count\":9999");
  EXPECT_NE(error(text).find("beyond the end of its buffer"), std::string::npos) << error(text);
}

TEST(FieldGltf, TheFirstVersionIsLeftToTheLibrary) {
  const test::WorldFiles files;
  EXPECT_EQ(plain_gltf(files.add("a.gltf", R"({"asset":{"version":1.0},"meshes":{}})")), "");
  EXPECT_EQ(plain_gltf(files.add("b.gltf", R"({"asset":{"version":"1.1"}})")), "");
  EXPECT_EQ(plain_gltf(files.add("c.glb", "glTF" + std::string("\1\0\0\0rest", 8))), "");
}

/// Digits and words of the format in each other's places: no crash, whatever the numbers say.
TEST(FieldGltf, DamagedTextsAreSaidOtherwiseOrRefused) {
  const test::WorldFiles files;
  test::GltfCube cube;
  cube.component = 5122;
  cube.sparse = true;
  cube.texture = R"({"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}})";
  files.add("cube.bin", test::gltf_numbers_of(cube));
  const std::string good = test::gltf_text(cube);
  const std::vector<std::string> words = {"4294967296", "-1",   "5121", "null", "[]",
                                          "{}",         "9e99", "0",    "\"\"", "\"VEC2\""};
  Rng rng(1, "damaged glTF");
  int said = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bad = good;
    for (std::size_t hits = 1 + rng.index(3); hits > 0; --hits) {
      const std::size_t at = bad.find_first_of("0123456789", rng.index(bad.size()));
      if (at == std::string::npos) continue;
      bad.replace(at, bad.find_first_not_of("0123456789.", at) - at,
                  words[rng.index(words.size())]);
    }
    try {
      said += plain_gltf(files.add("cube.gltf", bad)).empty() ? 0 : 1;
    } catch (const std::runtime_error& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
  EXPECT_GT(said, 10);
}

}  // namespace
}  // namespace canopeer
