#include "canopeer/eval/surface_coverage.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

/// A box of 6 × 6 × 6 cm as fruit 0; fruit 1 has no body.
Scene one_box() {
  Scene scene;
  scene.fruits.resize(2);
  scene.fruits[1].id = 1;
  ScenePart part;
  part.mesh = make_box(Box(Vec3::Zero(), Vec3::Constant(0.06)));
  part.kind = PartClass::fruit;
  part.fruit = 0;
  scene.parts.push_back(part);
  return scene;
}

/// Points every 2 mm on the box's top, up to x.
PointCloud top_up_to(float x_end) {
  PointCloud cloud;
  for (float x = 0.001F; x < x_end; x += 0.002F) {
    for (float y = 0.001F; y < 0.06F; y += 0.002F) cloud.points.emplace_back(x, y, 0.06F);
  }
  return cloud;
}

TEST(FruitCoverage, IsTheShareOfTheAreaWithASeenPointNearIt) {
  const Scene scene = one_box();
  EXPECT_EQ(fruit_coverage(scene, {}), (std::vector<double>{0.0, 0.0}));
  // One face of six, and a margin of 5 mm down the other four.
  const double top = fruit_coverage(scene, top_up_to(0.06F))[0];
  EXPECT_NEAR(top, (1.0 + 4.0 * 5.0 / 60.0) / 6.0, 0.03);
  const double half = fruit_coverage(scene, top_up_to(0.03F))[0];
  EXPECT_NEAR(half / top, 0.58, 0.08);
}

TEST(FruitCoverage, IsNeverMoreThanAll) {
  Scene scene = one_box();
  PointCloud cloud;
  for (const auto& v : scene.parts[0].mesh.vertices) cloud.points.push_back(v);
  EXPECT_LE(fruit_coverage(scene, cloud, 0.2)[0], 1.0);
  EXPECT_NEAR(fruit_coverage(scene, cloud, 0.2)[0], 1.0, 1e-12);
}

}  // namespace
}  // namespace canopeer
