#include <gtest/gtest.h>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rng.h"
#include "canopeer/config/scan_rows_file.h"
#include "canopeer/import/mesh_file.h"
#include "canopeer/import/meshes/collada_asset.h"
#include "canopeer/import/scene_glb.h"
#include "canopeer/import/sdf/sdf_world.h"
#include "mesh_writers.h"
#include "world_files.h"

namespace canopeer {
namespace {

// Files that were good and have been damaged at random: each must be read or refused with a message
// of one line. fuzz/ does the same led by coverage, for as long as one likes, with what we parse
// ourselves. The library that parses meshes ends its process, or hangs, over some.

/// Some bytes changed, put in twice, taken out, or replaced by a word of the format.
std::string damaged(std::string text, const std::vector<std::string>& words, Rng& rng) {
  const std::size_t hits = 1 + rng.index(4);
  for (std::size_t i = 0; i < hits && !text.empty(); ++i) {
    const std::size_t at = rng.index(text.size());
    const std::size_t length = std::min<std::size_t>(1 + rng.index(20), text.size() - at);
    switch (rng.index(5)) {
      case 0:
        text[at] = static_cast<char>(rng.index(256));
        break;
      case 1:
        text.insert(at, text.substr(at, length));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.replace(at, length, words[rng.index(words.size())]);
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

template <typename Result>
void expect_value_or_message(const Result& result, int round) {
  if (result) return;
  EXPECT_FALSE(result.error().message.empty()) << "round " << round;
}

TEST(DamagedFiles, ColladaHeadsAreReadOrRefused) {
  const std::string good =
      "<COLLADA><asset><!-- c --><unit name=\"cm\" meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset>";
  const std::vector<std::string> words = {"<asset",    "</asset>", "<!--", "-->",
                                          "<unit",     "meter=",   "\"",   "'",
                                          "<up_axis>", "1e999",    "<",    ">"};
  Rng rng(1, "damaged collada");
  for (int i = 0; i < 20000; ++i) {
    expect_value_or_message(parse_collada_asset(damaged(good, words, rng), "a.dae"), i);
  }
}

TEST(DamagedFiles, SceneFilesAreReadOrRefused) {
  const std::string good =
      "name: rows\nscans:\n  - name: a\n    mesh: a.ply\n    fruit_color: {hue_low_deg: -20}\n"
      "rows:\n  - {x_m: 1, y_from_m: 0, spacing_m: 0.5, count: 3, scans: [a]}\nplants:\n"
      "  - {scan: a, x_m: 1, y_m: 2}\nfloor: true\n";
  const std::vector<std::string> words = {"scans:", "{",  "}",  "[", "]",  "\n",    "  ",   "- ",
                                          "a: ",    "&x", "*x", "|", "\"", "1e999", "null", "!!"};
  Rng rng(2, "damaged scene file");
  for (int i = 0; i < 4000; ++i) {
    expect_value_or_message(parse_scan_rows(damaged(good, words, rng), "rows.yaml"), i);
  }
}

/// Damages `good` many times over; each time it must be read, whole and finite, or refused by name.
void expect_meshes_or_messages(const std::string& name, const std::string& good,
                               const std::vector<std::string>& words) {
  const test::WorldFiles files;
  const std::vector<test::Painted> surfaces = {{"red", test::ball(Vec3(0, 0, 1), 0.04), {}, ""}};
  files.add("good.mtl", test::mtl(surfaces));
  files.add("good.bin", test::gltf_bin(surfaces));
  // Other damage: --gtest_random_seed=N.
  Rng rng(5 + static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()),
          "damaged " + name);
  MeshFileOptions options;
  options.least_cpu_s = 1.0;
  options.least_memory_bytes = 256UL << 20U;
  int read = 0;
  int ended = 0;
  constexpr int kRounds = 200;
  for (int i = 0; i < kRounds; ++i) {
    const auto path = files.add(name, damaged(good, words, rng));
    TextureStore textures;
    const auto file = read_mesh_file(path, options, textures);
    if (!file) {
      EXPECT_EQ(file.error().message.find(path.string()), 0U) << file.error().message;
      ended += file.error().message.find("its reader") != std::string::npos;
      continue;
    }
    ++read;
    for (const MeshPiece& piece : file->pieces) {
      for (const auto& v : piece.mesh.vertices) ASSERT_TRUE(v.allFinite()) << name << i;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, kRounds);
  ::testing::Test::RecordProperty("readers_ended_" + name.substr(0, 1), ended);
}

std::vector<test::Painted> a_fruit() {
  return {{"red", test::ball(Vec3(0, 0, 1), 0.04), {204, 41, 9}, ""}};
}

TEST(DamagedFiles, ColladaMeshesAreReadOrRefused) {
  expect_meshes_or_messages("a.dae", test::dae(a_fruit()),
                            {"<node>", "</node>", "count=\"", "-1", "99999999", "#geo", "<p>",
                             "</p>", "nan", "<", "offset=\"7\""});
}

TEST(DamagedFiles, ObjMeshesAreReadOrRefused) {
  expect_meshes_or_messages("a.obj", test::obj(a_fruit(), "good.mtl"),
                            {"f ", "v ", "-1", "99999999", "/", "\n", "usemtl ", "1e400", "vt "});
}

TEST(DamagedFiles, StlMeshesAreReadOrRefused) {
  expect_meshes_or_messages("a.stl", test::ascii_stl(a_fruit()[0].mesh),
                            {"facet", "vertex", "solid", "1e400", "nan", "endloop"});
  expect_meshes_or_messages("b.stl", test::binary_stl(a_fruit()[0].mesh),
                            {std::string(4, '\xff'), std::string(4, '\0'), "solid "});
}

TEST(DamagedFiles, PlyMeshesAreReadOrRefused) {
  const std::vector<std::string> words = {
      "element vertex 99999999", "list ",  "property ", "uchar", "-1",
      std::string(4, '\xff'),    "format "};
  expect_meshes_or_messages("a.ply", test::colored_ply(a_fruit()), words);
  expect_meshes_or_messages("b.ply", test::binary_colored_ply(a_fruit()), words);
}

TEST(DamagedFiles, GltfMeshesAreReadOrRefused) {
  const std::vector<std::string> words = {"-1",  "99999999999", "{",    "}",
                                          "[0]", "\"count\":",  "1e99", "null"};
  expect_meshes_or_messages("a.gltf", test::gltf(a_fruit(), "good.bin"), words);
  Scene scene;
  ScenePart part;
  part.mesh = a_fruit()[0].mesh;
  compute_normals(part.mesh);
  scene.parts.push_back(part);
  const test::WorldFiles files;
  ASSERT_TRUE(write_scene_glb(files.path() / "good.glb", scene).has_value());
  expect_meshes_or_messages("a.glb", read_file(files.path() / "good.glb").value_or(""), words);
}

TEST(DamagedFiles, WorldsAreReadOrRefused) {
  const std::string box =
      "<visual name=\"v\"><geometry><box><size>1 2 3</size></box></geometry></visual>";
  const std::string good =
      "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\"><world name=\"w\"><frame name=\"f\" "
      "attached_to=\"m::l\"><pose>1 0 0 0 0 0</pose></frame><model name=\"m\"><pose "
      "relative_to=\"world\">1 2 3 0 0 0</pose><link name=\"l\"><pose "
      "degrees=\"true\">1 2 3 0 0 90</pose>" +
      box +
      "</link><model name=\"n\" placement_frame=\"k\"><link name=\"k\"><pose relative_to=\"j\"/>" +
      box +
      "</link><frame name=\"j\"/></model></model><population name=\"p\"><model name=\"q\"><link "
      "name=\"l\"/></model><box><size>1 1 1</size></box><model_count>3</model_count></population>"
      "<state world_name=\"w\"><model name=\"m\"><pose>4 5 6 0 0 0</pose><scale>1 1 2</scale><link "
      "name=\"l\"><pose>0 0 0 0 0 0</pose></link></model><insertions><model "
      "name=\"i\"/></insertions>"
      "</state></world></sdf>";
  const std::vector<std::string> words = {"<model name=\"m\">",
                                          "</model>",
                                          "<pose>",
                                          "</pose>",
                                          "nan",
                                          "1e400",
                                          "\"",
                                          "<state>",
                                          "version=\"1.5\"",
                                          "<include>",
                                          "<uri>x",
                                          "&lt;",
                                          "relative_to=\"f\"",
                                          "m::n::k",
                                          "::",
                                          "__model__",
                                          "<polyline>",
                                          "<link name=\"l\">",
                                          "1e308",
                                          "\n"};
  Rng rng(4, "damaged world");
  int read = 0;
  constexpr int kRounds = 20000;
  for (int i = 0; i < kRounds; ++i) {
    const auto world =
        parse_sdf_world(damaged(good, words, rng), "/nowhere/w.world", ModelPaths({}));
    expect_value_or_message(world, i);
    if (!world) {
      EXPECT_EQ(world.error().message.find_first_of("\r\n"), std::string::npos)
          << world.error().message;
      continue;
    }
    ++read;
    for (const SdfVisual& v : world->visuals)
      ASSERT_TRUE(v.T_world_visual.matrix().allFinite()) << i;
  }
  EXPECT_GT(read, kRounds / 100);
  EXPECT_LT(read, kRounds);
}

}  // namespace
}  // namespace canopeer
