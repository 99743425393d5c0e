#include "canopeer/import/mesh_file.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string_view>

#include "mesh_writers.h"
#include "world_files.h"

namespace canopeer {
namespace {

using test::Painted;

const Vec3 kRed(0.1, -0.2, 0.6);
const Vec3 kGreen(-0.15, 0.05, 0.9);

std::vector<Painted> two_fruits() {
  return {{"red", test::ball(kRed, 0.04), {204, 41, 9}, ""},
          {"green", test::ball(kGreen, 0.03), {162, 154, 35}, ""}};
}

MeshFile read(const std::filesystem::path& path, const MeshFileOptions& options = {}) {
  TextureStore textures;
  auto file = read_mesh_file(path, options, textures);
  EXPECT_TRUE(file.has_value()) << file.error().message;
  return file.value_or(MeshFile{});
}

std::string error_of(const std::filesystem::path& path) {
  TextureStore textures;
  const auto file = read_mesh_file(path, {}, textures);
  return file ? "" : file.error().message;
}

const MeshPiece& piece_named(const MeshFile& file, std::string_view material) {
  for (const MeshPiece& piece : file.pieces) {
    if (piece.names.material == material) return piece;
  }
  ADD_FAILURE() << "no material " << material;
  return file.pieces.front();
}

void expect_box(const Box& box, const Vec3& centre, double radius) {
  // Coordinates pass through floats of up to some thousand file units.
  constexpr double kTolerance = 2e-6;
  EXPECT_LT((box.min() - (centre - Vec3::Constant(radius))).norm(), kTolerance)
      << box.min().transpose();
  EXPECT_LT((box.max() - (centre + Vec3::Constant(radius))).norm(), kTolerance)
      << box.max().transpose();
}

TEST(MeshFile, ColladaMeansTheSameInAnyUnitAxisAndNodeMatrix) {
  const test::WorldFiles files;
  Eigen::Affine3d far = Eigen::Affine3d::Identity();
  far.translate(Vec3(120.0, -35.0, 80.0))
      .rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  Eigen::Affine3d stretched = Eigen::Affine3d::Identity();
  stretched.translate(Vec3(-0.3, 0.2, 0.1)).scale(Vec3(2.0, 0.5, 3.0));
  int cases = 0;
  for (const double unit_m : {1.0, 0.01, 0.0254, 1000.0}) {
    for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z}) {
      for (const auto& [outer, node] :
           {std::pair{Eigen::Affine3d::Identity(), Eigen::Affine3d::Identity()},
            std::pair{far, Eigen::Affine3d::Identity()}, std::pair{far, stretched}}) {
        // At 1 000 m a unit 100 units away is 100 km: floats have no millimetres left.
        if (unit_m > 1.0 && !outer.isApprox(Eigen::Affine3d::Identity())) continue;
        SCOPED_TRACE("unit " + std::to_string(unit_m) + ", axis " +
                     std::to_string(static_cast<int>(up)));
        const auto path =
            files.add("plant.dae", test::dae(two_fruits(), {unit_m, "meter", up, node, outer}));
        const MeshFile file = read(path);
        ASSERT_EQ(file.pieces.size(), 2U);
        // 120 units away in metres floats are good to 8 µm.
        const Box red = piece_named(file, "red").mesh.bounds();
        const Box green = piece_named(file, "green").mesh.bounds();
        EXPECT_LT((red.center() - kRed).norm(), 3e-5);
        EXPECT_LT((red.sizes() - Vec3::Constant(0.08)).norm(), 3e-5);
        EXPECT_LT((green.center() - kGreen).norm(), 3e-5);
        EXPECT_LT((green.sizes() - Vec3::Constant(0.06)).norm(), 3e-5);
        // Outside is outside.
        EXPECT_GT(piece_named(file, "red").mesh.volume(), 0.0);
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 30);
}

TEST(MeshFile, ColladaZUpWithATranslatedRootIsNotMisplaced) {
  const test::WorldFiles files;
  test::DaeStyle style;
  style.unit_m = 0.01;
  style.unit_name = "inch";  // lies; the value counts
  style.outer.translate(Vec3(100.0, 0.0, 30.0));
  const MeshFile file = read(files.add("plant.dae", test::dae(two_fruits(), style)));
  expect_box(piece_named(file, "red").mesh.bounds(), kRed, 0.04);
}

TEST(MeshFile, ColladaCoordinatesAreTakenAsTheyAreOnRequest) {
  const test::WorldFiles files;
  test::DaeStyle style;
  style.up = UpAxis::y;
  const auto path = files.add("plant.dae", test::dae(two_fruits(), style));
  const Box box = piece_named(read(path, {false}), "red").mesh.bounds();
  // y up: the file has (x, z, −y).
  expect_box(box, Vec3(kRed.x(), kRed.z(), -kRed.y()), 0.04);
}

TEST(MeshFile, NamesAndColoursComeFromTheFile) {
  const test::WorldFiles files;
  const MeshFile file = read(files.add("plant.dae", test::dae(two_fruits())));
  const MeshPiece& red = piece_named(file, "red");
  EXPECT_EQ(red.names.mesh, "plant_mesh");
  EXPECT_EQ(red.names.node, "inner");
  EXPECT_EQ(red.names.file, "plant.dae");
  EXPECT_EQ(red.color, (Rgb{204, 41, 9}));
  EXPECT_EQ(file.groups.front(), "outer");
}

TEST(MeshFile, ObjWithMaterialsIsTakenAsItIs) {
  const test::WorldFiles files;
  files.add("plant.mtl", test::mtl(two_fruits()));
  const MeshFile file = read(files.add("plant.obj", test::obj(two_fruits(), "plant.mtl")));
  expect_box(piece_named(file, "red").mesh.bounds(), kRed, 0.04);
  expect_box(piece_named(file, "green").mesh.bounds(), kGreen, 0.03);
  EXPECT_EQ(piece_named(file, "green").color, (Rgb{162, 154, 35}));
  EXPECT_EQ(piece_named(file, "green").names.mesh, "green_object");
}

TEST(MeshFile, StlIsTakenAsItIs) {
  const test::WorldFiles files;
  const MeshFile file = read(files.add("fruit.stl", test::binary_stl(test::ball(kRed, 0.04))));
  ASSERT_EQ(file.pieces.size(), 1U);
  expect_box(file.pieces[0].mesh.bounds(), kRed, 0.04);
  EXPECT_EQ(file.groups[0].empty(), false);
}

TEST(MeshFile, PlyKeepsItsVertexColours) {
  const test::WorldFiles files;
  const MeshFile file = read(files.add("plant.ply", test::colored_ply(two_fruits())));
  ASSERT_EQ(file.pieces.size(), 1U);
  const MeshPiece& piece = file.pieces[0];
  ASSERT_EQ(piece.vertex_colors.size(), piece.mesh.vertices.size());
  int red = 0;
  for (const Rgb& c : piece.vertex_colors) red += c == Rgb{204, 41, 9};
  EXPECT_GT(red, 50);
  EXPECT_LT(red, static_cast<int>(piece.vertex_colors.size()) - 50);
}

TEST(MeshFile, BinaryPlyAndTextStlAreReadToo) {
  const test::WorldFiles files;
  const MeshFile ply = read(files.add("plant.ply", test::binary_colored_ply(two_fruits())));
  ASSERT_EQ(ply.pieces.size(), 1U);
  EXPECT_EQ(ply.pieces[0].vertex_colors.front(), (Rgb{204, 41, 9}));
  EXPECT_EQ(ply.pieces[0].vertex_colors.back(), (Rgb{162, 154, 35}));
  const MeshFile stl = read(files.add("fruit.stl", test::ascii_stl(test::ball(kRed, 0.04))));
  expect_box(stl.pieces.at(0).mesh.bounds(), kRed, 0.04);
}

TEST(MeshFile, GltfTextWithItsNumbersBesideItStandsUp) {
  const test::WorldFiles files;
  files.add("plant.bin", test::gltf_bin(two_fruits()));
  const MeshFile file = read(files.add("plant.gltf", test::gltf(two_fruits(), "plant.bin")));
  expect_box(piece_named(file, "red").mesh.bounds(), kRed, 0.04);
  expect_box(piece_named(file, "green").mesh.bounds(), kGreen, 0.03);
  EXPECT_GT(piece_named(file, "red").mesh.volume(), 0.0);
  std::filesystem::remove(files.path() / "plant.bin");
  EXPECT_NE(error_of(files.path() / "plant.gltf").find("plant.gltf: cannot be read"),
            std::string::npos);
}

TEST(MeshFile, ClearMaterialsOfObjAreSeenThrough) {
  const test::WorldFiles files;
  files.add("pane.mtl", "newmtl glass\nKd 1 1 1\nd 0.2\nnewmtl wood\nKd 1 0.5 0\nd 0.9\n");
  const MeshFile file = read(files.add(
      "pane.obj",
      "mtllib pane.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl glass\nf 1 2 3\nusemtl "
      "wood\nf 1 2 4\n"));
  EXPECT_TRUE(piece_named(file, "glass").see_through);
  EXPECT_FALSE(piece_named(file, "wood").see_through);
}

TEST(MeshFile, AMissingTextureIsANoticeThatSaysWhoWantsIt) {
  const test::WorldFiles files;
  const auto path = files.add(
      "plant.dae", test::dae({{"leafy", test::ball(kRed, 0.04), {60, 83, 22}, "lost%20leaf.png"}}));
  const MeshFile file = read(path);
  ASSERT_EQ(file.pieces.size(), 1U);
  EXPECT_EQ(file.pieces[0].texture, nullptr);
  EXPECT_EQ(file.pieces[0].names.textures, std::vector<std::string>{"lost leaf.png"});
  ASSERT_EQ(file.notices.size(), 1U);
  for (const std::string word :
       {"lost", "not found", "leafy", "plant.dae", "without this texture"}) {
    EXPECT_NE(file.notices[0].find(word), std::string::npos) << file.notices[0];
  }
}

TEST(MeshFile, ABrokenTextureIsANoticeToo) {
  const test::WorldFiles files;
  files.add("materials/textures/leaf.png", "\x89PNG\r\n\x1a\nno picture");
  const auto path = files.add(
      "meshes/plant.dae", test::dae({{"leafy", test::ball(kRed, 0.04), {60, 83, 22}, "leaf.png"}}));
  const MeshFile file = read(path);
  ASSERT_EQ(file.notices.size(), 1U);
  EXPECT_NE(file.notices[0].find("leaf.png"), std::string::npos) << file.notices[0];
  EXPECT_NE(file.notices[0].find("plant.dae"), std::string::npos) << file.notices[0];
}

TEST(MeshFile, WhatCannotBeReadIsNamed) {
  const test::WorldFiles files;
  EXPECT_NE(error_of(files.path() / "no.dae").find("no.dae: no such mesh file"), std::string::npos);
  EXPECT_NE(error_of(files.add("a.blend", "x")).find("expected a mesh, .dae"), std::string::npos);
  EXPECT_NE(error_of(files.add("empty.obj", "# nothing\n")).find("empty.obj"), std::string::npos);
  for (const char* name : {"a.dae", "a.obj", "a.stl", "a.gltf", "a.glb", "a.ply"}) {
    for (const std::string content : {"", "rubbish", "\x01\x02\x03\xff\xff\xff\xff"}) {
      EXPECT_NE(error_of(files.add(name, content)).find(name), std::string::npos) << name;
    }
  }
}

TEST(MeshFile, FilesThatAreCutOffAreErrorsOrShorterNeverWorse) {
  const test::WorldFiles files;
  files.add("plant.mtl", test::mtl(two_fruits()));
  files.add("plant.bin", test::gltf_bin(two_fruits()));
  for (const auto& [name, content] :
       {std::pair{"plant.dae", test::dae(two_fruits())},
        std::pair{"plant.obj", test::obj(two_fruits(), "plant.mtl")},
        std::pair{"plant.stl", test::binary_stl(test::ball(kRed, 0.04))},
        std::pair{"text.stl", test::ascii_stl(test::ball(kRed, 0.04))},
        std::pair{"plant.ply", test::colored_ply(two_fruits())},
        std::pair{"binary.ply", test::binary_colored_ply(two_fruits())},
        std::pair{"plant.gltf", test::gltf(two_fruits(), "plant.bin")}}) {
    for (int i = 1; i < 24; ++i) {
      const auto path = files.add(name, content.substr(0, content.size() * i / 24));
      TextureStore textures;
      const auto file = read_mesh_file(path, {}, textures);
      if (!file) {
        EXPECT_NE(file.error().message.find(name), std::string::npos);
      }
      if (!file) continue;
      for (const MeshPiece& piece : file->pieces) {
        EXPECT_TRUE(piece.mesh.bounds().min().allFinite()) << name;
      }
    }
  }
}

}  // namespace
}  // namespace canopeer
