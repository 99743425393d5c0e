#include "canopeer/import/meshes/file_mesh.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "mesh_writers.h"

namespace canopeer {
namespace {

FileMesh some_mesh() {
  FileMesh mesh;
  FileMesh::Part part;
  part.piece.mesh = test::ball(Vec3(1, 2, 3), 0.1);
  compute_normals(part.piece.mesh);
  for (const auto& v : part.piece.mesh.vertices) {
    part.piece.uv.emplace_back(v.x(), v.y());
    part.piece.vertex_colors.push_back({1, 2, 3});
  }
  part.piece.names.mesh = "ball";
  part.piece.names.node = "node";
  part.material = 1;
  part.group = "plant";
  mesh.parts = {part, part};
  mesh.materials.resize(2);
  mesh.materials[1] = {"red", {200, 1, 2}, "red.png", "mask.png", false, 77, true, true};
  mesh.pictures["*0"] = std::string("\x89PNG\0x", 6);
  mesh.notices = {"something"};
  return mesh;
}

TEST(FileMesh, ComesBackAsItWas) {
  const FileMesh mesh = some_mesh();
  const auto back = decode_file_mesh(encode(mesh));
  ASSERT_TRUE(back.has_value()) << back.error().message;
  ASSERT_EQ(back->parts.size(), 2U);
  const MeshPiece& piece = back->parts[1].piece;
  EXPECT_EQ(piece.mesh.vertices, mesh.parts[1].piece.mesh.vertices);
  EXPECT_EQ(piece.mesh.normals, mesh.parts[1].piece.mesh.normals);
  EXPECT_EQ(piece.mesh.triangles, mesh.parts[1].piece.mesh.triangles);
  EXPECT_EQ(piece.uv, mesh.parts[1].piece.uv);
  EXPECT_EQ(piece.vertex_colors, mesh.parts[1].piece.vertex_colors);
  EXPECT_EQ(piece.names.mesh, "ball");
  EXPECT_EQ(piece.names.node, "node");
  EXPECT_EQ(back->parts[1].material, 1U);
  EXPECT_EQ(back->parts[1].group, "plant");
  EXPECT_EQ(back->materials[1].name, "red");
  EXPECT_EQ(back->materials[1].color, (Rgb{200, 1, 2}));
  EXPECT_EQ(back->materials[1].picture, "red.png");
  EXPECT_EQ(back->materials[1].mask, "mask.png");
  EXPECT_FALSE(back->materials[1].alpha_cuts);
  EXPECT_EQ(back->materials[1].cut_below, 77);
  EXPECT_TRUE(back->materials[1].see_through);
  EXPECT_EQ(back->pictures, mesh.pictures);
  EXPECT_EQ(back->notices, mesh.notices);
}

TEST(FileMesh, EveryShorterMessageIsRefused) {
  const std::string bytes = encode(some_mesh());
  for (std::size_t n = 0; n < bytes.size(); n += 7) {
    EXPECT_FALSE(decode_file_mesh(bytes.substr(0, n)).has_value()) << n;
  }
  EXPECT_FALSE(decode_file_mesh(bytes + "x").has_value());
}

TEST(FileMesh, DamagedMessagesAreSoundOrRefused) {
  const std::string bytes = encode(some_mesh());
  Rng rng(1, "damaged message");
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 3; ++k)
      damaged[rng.index(bytes.size())] = static_cast<char>(rng.index(256));
    const auto mesh = decode_file_mesh(damaged);
    if (!mesh) ++refused;
    if (!mesh) continue;
    for (const FileMesh::Part& part : mesh->parts) {
      for (const auto& t : part.piece.mesh.triangles) {
        for (const auto corner : t) ASSERT_LT(corner, part.piece.mesh.vertices.size());
      }
    }
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace canopeer
