#include "canopeer/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

TEST(TriangleMesh, BoxHasItsVolumeAreaAndOutwardNormals) {
  TriangleMesh box = make_box(Box(Vec3(1, 2, 3), Vec3(2, 4, 6)));
  EXPECT_NEAR(box.volume(), 6.0, 1e-6);
  EXPECT_NEAR(box.area(), 22.0, 1e-5);
  compute_normals(box);
  const Eigen::Vector3f centre(1.5F, 3.0F, 4.5F);
  for (std::size_t i = 0; i < box.vertices.size(); ++i) {
    EXPECT_GT(box.normals[i].dot(box.vertices[i] - centre), 0.0F);
  }
}

TEST(TriangleMesh, AppendMapsTheOtherMesh) {
  const TriangleMesh unit = make_box(Box(Vec3::Zero(), Vec3::Ones()));
  Pose T = Pose::Identity();
  T.translation() = Vec3(5, 0, 0);
  TriangleMesh both = unit;
  both.append(unit, T);
  EXPECT_NEAR(both.volume(), 2.0, 1e-6);
  EXPECT_TRUE(both.bounds().max().isApprox(Vec3(6, 1, 1)));
}

}  // namespace
}  // namespace canopeer
