#include "canopeer/import/sdf/extrusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

const Outline kAngle = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};  // an L, 4 m²

TEST(ExtrudedMesh, HasTheVolumeOfItsOutlineTimesItsHeight) {
  const auto mesh = extruded_mesh(kAngle, 0.5);
  ASSERT_TRUE(mesh.has_value());
  EXPECT_NEAR(mesh->volume(), 2.0, 1e-6);
  EXPECT_NEAR(mesh->bounds().min().z(), 0.0, 1e-9);
  EXPECT_NEAR(mesh->bounds().max().z(), 0.5, 1e-7);
  EXPECT_NEAR(mesh->area(), 2 * 4.0 + 0.5 * 10.0, 1e-5);
}

TEST(ExtrudedMesh, TurnsEitherWayAndClosesItself) {
  const Outline back(kAngle.rbegin(), kAngle.rend());
  EXPECT_NEAR(extruded_mesh(back, 0.5)->volume(), 2.0, 1e-6);
  Outline closed = kAngle;
  closed.push_back(closed.front());
  closed.insert(closed.begin() + 1, {1, 0});  // on a straight line
  EXPECT_NEAR(extruded_mesh(closed, 0.5)->volume(), 2.0, 1e-6);
}

TEST(ExtrudedMesh, OfStarsOfAnyShapeIsExact) {
  Rng rng(3, "stars");
  for (int round = 0; round < 200; ++round) {
    Outline star;
    const std::size_t n = 3 + rng.index(40);
    double area = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(n);
      const double radius = 0.2 + rng.uniform();
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto& a = star[i];
      const auto& b = star[(i + 1) % n];
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    const auto mesh = extruded_mesh(star, 2.0);
    ASSERT_TRUE(mesh.has_value()) << round;
    EXPECT_NEAR(mesh->volume(), 2.0 * area, 1e-5) << round;
  }
}

TEST(ExtrudedMesh, OfNoOutlineIsNone) {
  EXPECT_FALSE(extruded_mesh({}, 1.0).has_value());
  EXPECT_FALSE(extruded_mesh({{0, 0}, {1, 0}}, 1.0).has_value());
  EXPECT_FALSE(extruded_mesh({{0, 0}, {1, 0}, {2, 0}}, 1.0).has_value());
  EXPECT_FALSE(extruded_mesh(kAngle, 0.0).has_value());
  EXPECT_FALSE(extruded_mesh(kAngle, std::nan("")).has_value());
  const double nan = std::nan("");
  EXPECT_FALSE(extruded_mesh({{0, 0}, {1, nan}, {2, 1}, {0, 3}}, 1.0).has_value());
}

}  // namespace
}  // namespace canopeer
