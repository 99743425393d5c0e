#include "canopeer/fruit/surface/fruit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../detect/synthetic_view.h"
#include "canopeer/fruit/missing_surface.h"

namespace canopeer {
namespace {

using namespace synthetic;

const Vec3 kCentre(0.6, 0.0, 0.6);
constexpr double kRadius = 0.035;

/// The surface after views of the bodies from the cameras, classes as the truth says.
FruitSurface seen_from(const std::vector<Body>& bodies, const std::vector<Vec3>& cameras) {
  FruitSurface surface({});
  for (const Vec3& camera : cameras) {
    const View view = look(bodies, camera, kCentre);
    Mask classes = view.fruit;
    for (auto& c : classes.pixels()) c = c != 0 ? 3 : 0;
    surface.add(view.frame, classes);
    surface.update();
  }
  return surface;
}

std::vector<Vec3> ring(int cameras) {
  std::vector<Vec3> positions;
  for (int i = 0; i < cameras; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / cameras;
    positions.push_back(kCentre +
                        Vec3(0.5 * std::cos(angle), 0.5 * std::sin(angle), i % 2 ? 0.25 : -0.25));
  }
  return positions;
}

TEST(FruitSurface, OfABallLiesOnItWithNormalsOutward) {
  const SurfaceMesh mesh = seen_from({ball(kCentre, kRadius, kRipe, true)}, ring(8)).mesh();
  ASSERT_GT(mesh.vertices.size(), 600U);
  double mean = 0.0;
  for (const SurfaceVertex& v : mesh.vertices) {
    const Vec3 d = v.surface.point - kCentre;
    // Half a voxel: projective distances overestimate where a surface is seen aslant.
    EXPECT_NEAR(d.norm(), kRadius, 0.002);
    mean += (d.norm() - kRadius) / static_cast<double>(mesh.vertices.size());
    EXPECT_GT(v.surface.normal.dot(d.normalized()), 0.85);
    EXPECT_GT(v.fruit_share, 0.9F);
    EXPECT_EQ(v.kind, PixelLabel::ripe_fruit);
    EXPECT_GT(v.color.r, 2 * v.color.g);
  }
  EXPECT_LT(std::abs(mean), 0.0005);
}

TEST(FruitSurface, MeshFacesOutwardAndHasTheBallsArea) {
  const SurfaceMesh mesh = seen_from({ball(kCentre, kRadius, kRipe, true)}, ring(12)).mesh();
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].surface.point;
    const Vec3 b = mesh.vertices[t[1]].surface.point;
    const Vec3 c = mesh.vertices[t[2]].surface.point;
    const Vec3 n = 0.5 * (b - a).cross(c - a);
    EXPECT_GE(n.dot(a - kCentre), -1e-8);
    area += n.norm();
  }
  const double whole = 4.0 * std::numbers::pi * kRadius * kRadius;
  EXPECT_NEAR(area / whole, 0.97, 0.06);
}

TEST(FruitSurface, IsCarvedAwayWhereLaterFramesSeeThrough) {
  FruitSurface surface({});
  const View there = look({ball(kCentre, kRadius, kRipe, true)}, {0.0, 0.0, 0.6}, kCentre);
  Mask classes = there.fruit;
  for (auto& c : classes.pixels()) c = c != 0 ? 3 : 0;
  surface.add(there.frame, classes);
  surface.update();
  EXPECT_GT(surface.mesh().vertices.size(), 100U);
  // The fruit was picked: now the camera sees the wall behind.
  const View gone =
      look({block(Box(Vec3(1.0, -2, -2), Vec3(1.1, 2, 2)), kLeaf)}, {0.0, 0.0, 0.6}, kCentre);
  for (int i = 0; i < 8; ++i) surface.add(gone.frame, Mask(320, 240, 0));
  surface.update();
  EXPECT_EQ(surface.mesh().vertices.size(), 0U);
}

TEST(FruitSurface, KnowsLeavesFromFruitByTheirPixels) {
  const Body leaf = block(Box(Vec3(0.555, -0.06, 0.59), Vec3(0.557, 0.06, 0.62)), kLeaf);
  const FruitSurface surface =
      seen_from({ball(kCentre, kRadius, kRipe, true), leaf}, {{0.0, 0.0, 0.62}, {0.0, 0.1, 0.7}});
  int on_leaf = 0;
  for (const SurfaceVertex& v : surface.mesh().vertices) {
    if (v.surface.point.x() > 0.5595) continue;
    ++on_leaf;
    EXPECT_LT(v.fruit_share, 0.5F);
  }
  EXPECT_GT(on_leaf, 20);
}

TEST(MissingSurface, OfABallSeenFromOneSideIsTheOther) {
  Superellipsoid body;
  body.semi_axes_m = Vec3::Constant(0.04);
  std::vector<SurfacePoint> seen;
  for (const SurfacePoint& s : body.surface_samples(2000)) {
    if (s.point.x() < 0.0) seen.push_back(s);
  }
  const MissingSurface missing = missing_surface(body, seen, 1000, 0.015);
  for (const SurfacePoint& s : missing.points) EXPECT_GT(s.point.x(), 0.01);
  // A cap beyond the chord of 1.5 cm: its height is R (1 − sin δ), δ = 2 asin(0.015 / 2R).
  const double delta = 2.0 * std::asin(0.015 / 0.08);
  EXPECT_NEAR(1.0 - missing.seen_share(), 0.5 * (1.0 - std::sin(delta)), 0.02);
  EXPECT_EQ(missing_surface(body, {}, 100).seen_share(), 0.0);
}

}  // namespace
}  // namespace canopeer
