#include <gtest/gtest.h>

#include "canopeer/import/mesh_file.h"
#include "field_meshes.h"
#include "mesh_writers.h"

namespace canopeer {
namespace {

using namespace std::string_literals;

TEST(FieldMeshes, PlyDataMayBeginWithAnEndOfLine) {
  const test::WorldFiles files;
  for (int red = 0; red < 256; ++red) {
    if (red != 9 && red != 10 && red != 11 && red != 13 && red != 32) continue;
    std::string ply =
        "ply\nformat binary_little_endian 1.0\ncomment of a scanner\nelement vertex 8\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float x\n"
        "property float y\nproperty float z\nelement face 12\n"
        "property list uchar int vertex_indices\nend_header\n";
    const TriangleMesh cube = make_box(Box(Vec3::Constant(-0.04), Vec3::Constant(0.04)));
    ASSERT_EQ(cube.vertices.size(), 8U);
    for (const auto& v : cube.vertices) {
      ply += static_cast<char>(red) + "\0\0"s;
      ply.append(reinterpret_cast<const char*>(v.data()), 12);
    }
    for (const auto& t : cube.triangles) {
      ply += '\3';
      ply.append(reinterpret_cast<const char*>(t.data()), 12);
    }
    const auto read = test::import_all_as_fruit(files.add("red.ply", ply));
    ASSERT_EQ(read.error, "") << red;
    ASSERT_EQ(read.world.scene.fruits.size(), 1U) << red;
    EXPECT_NEAR(read.world.scene.fruits.front().volume_cm3, 512.0, 0.1) << red;
    EXPECT_EQ(read.world.scene.parts.front().vertex_colors.front(),
              (Rgb{static_cast<std::uint8_t>(red), 0, 0}));
  }
}

TEST(FieldMeshes, ThePictureOfAPlyIsFound) {
  const test::WorldFiles files;
  files.add("my skin.tga", test::tga({200, 30, 10}));
  const auto read = test::import_all_as_fruit(files.add(
      "leaf.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile my skin.tga\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n"
      "3 0 1 2\n"));
  ASSERT_EQ(read.error, "");
  ASSERT_NE(read.world.scene.parts.front().texture, nullptr);
  EXPECT_EQ(read.world.scene.parts.front().texture->color.at(0, 0), (Rgb{200, 30, 10}));
}

TEST(FieldMeshes, FacesOfPointsAndLinesDoNotRefuseAMesh) {
  const test::WorldFiles files;
  const auto mixed = test::import_all_as_fruit(
      files.add("mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1\nf 1 2\nf 1 2 3\n"));
  EXPECT_EQ(mixed.error, "");
  EXPECT_EQ(mixed.world.scene.triangle_count(), 1U);
  for (const char* none :
       {"# a scan\nv 0 0 0\np 1\n", "v 0 0 0\nv 1 0 0\nl 1 2\n", "# a scan\nv 0 0 0\n"}) {
    const std::string error = test::import_all_as_fruit(files.add("none.obj", none)).error;
    EXPECT_NE(error.find("none.obj: holds no triangles"), std::string::npos) << error;
  }
}

TEST(FieldMeshes, WhatHasNoShapeGetsNone) {
  const test::WorldFiles files;
  const auto path = files.add(
      "cameras.dae",
      "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
      "version=\"1.4.1\"><asset><unit meter=\"1\"/><up_axis>Z_UP</up_axis></asset>"
      "<library_visual_scenes><visual_scene id=\"s\"><node id=\"a\" name=\"a\"><translate>1 2 3"
      "</translate><node id=\"b\" name=\"b\"/></node></visual_scene></library_visual_scenes>"
      "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
  const std::string error = test::import_all_as_fruit(path).error;
  EXPECT_NE(error.find("holds no triangles"), std::string::npos) << error;
}

TEST(FieldMeshes, OtherKindsAreNamedByTheirContent) {
  const test::WorldFiles files;
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"Kaydara FBX Binary  \0\x1a"s, "is FBX; open it"},
      {"; FBX 7.4.0 project file\n", "is FBX as text"},
      {"ISO-10303-21;\nHEADER;", "is STEP, a CAD model without triangles"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n",
       "is a Git LFS pointer, not the file itself"},
      {"PK\x03\x04rest", "is a ZIP archive"},
      {"BLENDER-v300", "is a Blender file"},
      {"\x1f\x8b\x08rest", "is packed with gzip; unpack it first"},
      {"<!DOCTYPE html><html>", "is a web page"},
      {"# .PCD v0.7", "is PCD, a cloud of points"},
      {"", "is empty"}};
  for (const auto& [content, words] : kinds) {
    for (const char* name : {"plant.fbx", "plant.stl", "plant.obj", "plant.glb"}) {
      const auto path = files.add(name, content);
      const std::string error = test::import_all_as_fruit(path).error;
      if (content.empty() && path.extension() == ".fbx") continue;  // an SDF world without text
      EXPECT_EQ(error.find(path.string() + ": " + words), 0U) << error;
    }
    const auto world = files.add_world("<model name=\"m\"><link name=\"l\">" +
                                       test::mesh_visual("plant.stl") + "</link></model>");
    const std::string error = test::import_all_as_fruit(world).error;
    EXPECT_NE(error.find("plant.stl: " + words), std::string::npos) << error;
    EXPECT_NE(error.find("world.world:4: visual 'visual' of model 'm' refers to it"),
              std::string::npos)
        << error;
  }
}

TEST(FieldMeshes, AMeshUnderAnotherNameIsSaid) {
  const test::WorldFiles files;
  const std::vector<test::Painted> surfaces = {
      {"red", test::ball(Vec3::Zero(), 0.04), {200, 40, 10}, ""}};
  const auto dae = files.add("plant.stl", test::dae(surfaces));
  EXPECT_EQ(test::import_all_as_fruit(dae).error,
            dae.string() + ": holds what belongs into a .dae file; give it that ending");
  const auto capitals = files.add("PLANT.DAE", test::dae(surfaces));
  EXPECT_EQ(test::import_all_as_fruit(capitals).error, "");
}

TEST(FieldMeshes, AMeshInMillimetresIsNoticed) {
  const test::WorldFiles files;
  const auto path = files.add("plant.stl", test::binary_stl(test::ball(Vec3::Zero(), 600.0)));
  const auto read = test::import_all_as_fruit(path);
  ASSERT_EQ(read.error, "");
  ASSERT_FALSE(read.world.notices.empty());
  EXPECT_NE(read.world.notices.front().find("is 1200 m in size"), std::string::npos);
  EXPECT_NE(read.world.notices.front().find("in millimetres it would be 1.2 m"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
