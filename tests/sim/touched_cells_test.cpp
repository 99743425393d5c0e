#include "canopeer/sim/touched_cells.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

constexpr double kEdge = 0.01;

Vec3 any_point(Rng& rng, double size) {
  const double x = rng.uniform(-size, size);
  const double y = rng.uniform(-size, size);
  const double z = rng.uniform(-size, size);
  return {x, y, z};
}

bool marked(const TouchedCells& cells, const VoxelIndex& cell) {
  const auto block = cells.blocks().find(block_key(cell));
  return block != cells.blocks().end() && block->second.test(cell);
}

TEST(TouchedCells, HoldEveryPointOfATriangleAndNothingFarFromIt) {
  Rng rng(1, "triangles");
  for (int i = 0; i < 200; ++i) {
    TriangleMesh mesh;
    const double size = i % 2 == 0 ? 0.02 : 0.2;
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(any_point(rng, size).cast<float>());
    mesh.triangles = {{0, 1, 2}};
    TouchedCells cells(kEdge, Box(Vec3::Constant(-1.0), Vec3::Constant(1.0)));
    cells.add(mesh, Pose::Identity());
    const Vec3 a = mesh.vertices[0].cast<double>();
    const Vec3 b = mesh.vertices[1].cast<double>();
    const Vec3 c = mesh.vertices[2].cast<double>();
    for (int k = 0; k < 200; ++k) {
      double u = rng.uniform(0.0, 1.0);
      double v = rng.uniform(0.0, 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      EXPECT_TRUE(marked(cells, voxel_at(a + u * (b - a) + v * (c - a), kEdge)));
    }
    // A cell's centre is no farther from the triangle's plane than a marked box reaches.
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (const auto& [key, mask] : cells.blocks()) {
      for_each_voxel(key, mask, [&](const VoxelIndex& cell) {
        const double off = std::abs(normal.dot(voxel_centre(cell, kEdge) - a));
        EXPECT_LE(off, 2.0 * std::sqrt(3.0) * kEdge);
      });
    }
  }
}

TEST(TouchedCells, LeaveOutWhatIsFarAway) {
  TriangleMesh floor;
  floor.vertices = {{-50.0F, -50.0F, 0.0F}, {50.0F, -50.0F, 0.0F}, {0.0F, 50.0F, 0.0F}};
  floor.triangles = {{0, 1, 2}};
  TouchedCells cells(kEdge, Box(Vec3(-0.3, -0.3, -0.3), Vec3(0.3, 0.3, 0.3)));
  cells.add(floor, Pose::Identity());
  EXPECT_TRUE(marked(cells, voxel_at(Vec3(0.29, -0.29, 0.0), kEdge)));
  std::size_t count = 0;
  for (const auto& [key, mask] : cells.blocks()) count += static_cast<std::size_t>(mask.count());
  EXPECT_GE(count, 3600U);
  EXPECT_LE(count, 3 * 3600U);
}

}  // namespace
}  // namespace canopeer
