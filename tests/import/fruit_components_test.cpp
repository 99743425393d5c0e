#include "canopeer/import/assembly/fruit_components.h"

#include <gtest/gtest.h>

#include <numbers>

#include "canopeer/import/shape_mesh.h"
#include "mesh_writers.h"

namespace canopeer {
namespace {

MeshPiece piece_of(const TriangleMesh& mesh) {
  MeshPiece piece;
  piece.mesh = mesh;
  return piece;
}

/// As files have it: every triangle with vertices of its own.
TriangleMesh exploded(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const auto i : t) result.vertices.push_back(mesh.vertices[i]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(FruitComponents, TrianglesThatTouchAreOneFruit) {
  TriangleMesh both = exploded(test::ball(Vec3(0, 0, 0.5), 0.03));
  both.append(exploded(test::ball(Vec3(0.2, 0, 0.5), 0.04)));
  const std::vector<MeshPiece> pieces = {piece_of(both)};
  const auto found = find_fruits(pieces, {});
  ASSERT_EQ(found.components.size(), 2U);
  EXPECT_LT((found.components[0].hull.centroid - Vec3(0, 0, 0.5)).norm(), 1e-6);
  EXPECT_LT((found.components[1].hull.centroid - Vec3(0.2, 0, 0.5)).norm(), 1e-6);
  EXPECT_NEAR(found.components[1].hull.volume_m3 * 1e6,
              test::volume_cm3(test::ball(Vec3(0, 0, 0), 0.04)), 0.01);
  EXPECT_NEAR(found.components[0].surface_m2, test::ball(Vec3(0, 0, 0), 0.03).area(), 1e-7);
}

TEST(FruitComponents, OneFruitMayHaveSeveralMaterials) {
  const TriangleMesh whole = test::ball(Vec3(0, 0, 0), 0.03);
  TriangleMesh lower = whole;
  TriangleMesh upper = whole;
  const auto high = [&](const std::array<std::uint32_t, 3>& t) {
    return (whole.vertices[t[0]] + whole.vertices[t[1]] + whole.vertices[t[2]]).z() > 0.0F;
  };
  std::erase_if(lower.triangles, high);
  std::erase_if(upper.triangles, [&](const auto& t) { return !high(t); });
  const std::vector<MeshPiece> pieces = {piece_of(lower), piece_of(upper)};
  EXPECT_EQ(find_fruits(pieces, {}).components.size(), 1U);
}

TEST(FruitComponents, AnOpenMeshHasTheVolumeOfItsHull) {
  // A tube, open at both ends: 32 sides, radius 3 cm, length 8 cm.
  TriangleMesh tube = cylinder_mesh(0.03, 0.08);
  std::erase_if(tube.triangles,
                [&](const auto& t) { return std::abs(tube.normals[t[0]].z()) > 0.5F; });
  const std::vector<MeshPiece> pieces = {piece_of(tube)};
  const auto found = find_fruits(pieces, {});
  ASSERT_EQ(found.components.size(), 1U);
  const double side = 2.0 * std::numbers::pi / 32.0;
  const double base = 0.5 * 32.0 * 0.03 * 0.03 * std::sin(side);
  EXPECT_NEAR(found.components[0].hull.volume_m3, base * 0.08, 1e-9);
  EXPECT_LT(std::abs(tube.volume()), 0.9 * base * 0.08);  // what an open mesh says itself
}

TEST(FruitComponents, AnInnerShellIsPartOfTheFruit) {
  const std::vector<MeshPiece> pieces = {piece_of(test::ball(Vec3(0, 0, 0), 0.035)),
                                         piece_of(test::ball(Vec3(0, 0, 0), 0.036)),
                                         piece_of(test::ball(Vec3(0.001, 0, 0), 0.01))};
  const auto found = find_fruits(pieces, {});
  ASSERT_EQ(found.components.size(), 1U);
  for (const auto& of_piece : found.component_of) {
    for (const int component : of_piece) EXPECT_EQ(component, 0);
  }
}

TEST(FruitComponents, ScrapsAndFlatBitsAreNoFruits) {
  const std::vector<MeshPiece> pieces = {piece_of(test::ball(Vec3(0, 0, 0), 0.003)),
                                         piece_of(test::sheet(Vec3(1, 1, 1), Vec3(1.2, 1.2, 1)))};
  const auto found = find_fruits(pieces, {});
  EXPECT_TRUE(found.components.empty());
  EXPECT_EQ(found.scraps, 2);
  EXPECT_EQ(found.component_of[1][0], -1);
}

TEST(MeasureFruit, TakesALongAxisWhereThereIsOneAndElseTheUprightOne) {
  const auto size_of = [](const Vec3& radii, double tilt_rad) {
    TriangleMesh mesh = ellipsoid_mesh(radii);
    std::vector<Vec3> points;
    for (const auto& v : mesh.vertices) {
      points.push_back(Eigen::AngleAxisd(tilt_rad, Vec3::UnitX()) * v.cast<double>());
    }
    return measure_fruit(*convex_hull(points));
  };
  // A pepper, upright and tilted; 32 sides cost less than 1 %.
  for (const double tilt : {0.0, 0.3}) {
    const FruitSize pepper = size_of(Vec3(0.03, 0.034, 0.037), tilt);
    EXPECT_NEAR(pepper.length_m, 0.074, 0.001) << tilt;
    EXPECT_NEAR(pepper.diameter_m, 0.068, 0.001) << tilt;
  }
  // A flat tomato: its axis is the short one. A cucumber lying down: the long one.
  EXPECT_NEAR(size_of(Vec3(0.04, 0.04, 0.03), 0.0).length_m, 0.06, 0.001);
  const FruitSize cucumber = size_of(Vec3(0.02, 0.02, 0.1), std::numbers::pi / 2.0);
  EXPECT_NEAR(cucumber.length_m, 0.2, 0.001);
  EXPECT_NEAR(cucumber.diameter_m, 0.04, 0.001);
}

}  // namespace
}  // namespace canopeer
