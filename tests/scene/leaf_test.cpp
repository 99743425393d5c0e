#include "canopeer/scene/plants/leaf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canopeer {
namespace {

Vec3 area_vector(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Eigen::Vector3f a = mesh.vertices[t[1]] - mesh.vertices[t[0]];
  const Eigen::Vector3f b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
  return 0.5 * a.cross(b).cast<double>();
}

/// Mean angle between the local normals and the leaf's mean normal, weighted by area, degrees.
double normal_deviation_deg(const TriangleMesh& blade) {
  Vec3 sum = Vec3::Zero();
  for (const auto& t : blade.triangles) sum += area_vector(blade, t);
  double weighted = 0.0;
  for (const auto& t : blade.triangles) {
    const Vec3 n = area_vector(blade, t);
    const double c = std::clamp(n.normalized().dot(sum.normalized()), -1.0, 1.0);
    weighted += n.norm() * std::acos(c);
  }
  return weighted / blade.area() * 180.0 / std::numbers::pi;
}

TEST(Leaf, IsCurvedAndHasTheMeasuredAreaShare) {
  // PLANTS: area 0.73 · length · width, local normals 22° off the mean normal.
  Rng rng(3);
  double deviation = 0.0;
  double share = 0.0;
  constexpr int kLeaves = 300;
  for (int i = 0; i < kLeaves; ++i) {
    const LeafForm leaf = draw_leaf(0.45, false, false, rng);
    const TriangleMesh blade = make_blade(leaf, Vec3::Zero());
    deviation += normal_deviation_deg(blade) / kLeaves;
    share += blade.area() / (leaf.length_m * leaf.width_m) / kLeaves;
  }
  EXPECT_NEAR(deviation, 22.0, 3.0);
  EXPECT_NEAR(share, 0.73, 0.03);
}

TEST(Leaf, SizesFollowTheTable) {
  Rng rng(4);
  double length = 0.0;
  double pitch = 0.0;
  constexpr int kLeaves = 2000;
  for (int i = 0; i < kLeaves; ++i) {
    const LeafForm leaf = draw_leaf(0.35, false, false, rng);
    length += leaf.length_m / kLeaves;
    pitch += leaf.blade_pitch_rad / kLeaves;
  }
  EXPECT_NEAR(length, 0.163, 0.002);
  EXPECT_NEAR(pitch * 180.0 / std::numbers::pi, -37.0, 3.0);
}

TEST(Leaf, BeginsWhereItsPetioleEnds) {
  Rng rng(5);
  LeafForm leaf = draw_leaf(0.35, false, false, rng);
  leaf.azimuth_rad = 1.0;
  const Vec3 end = petiole_end(leaf, Vec3(0.1, 0.2, 0.3));
  EXPECT_NEAR((end - Vec3(0.1, 0.2, 0.3)).norm(), leaf.petiole_m, 1e-9);
  const TriangleMesh blade = make_blade(leaf, end);
  EXPECT_LT((blade.vertices.front().cast<double>() - end).norm(), 1e-6);
  EXPECT_LT((blade.vertices.back().cast<double>() - end).norm(), leaf.length_m);
}

}  // namespace
}  // namespace canopeer
