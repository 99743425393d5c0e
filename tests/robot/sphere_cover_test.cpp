#include "canopeer/robot/sphere_cover.h"

#include "canopeer/robot/collision/convex_gap.h"
#include "robot_fixture.h"

namespace canopeer {
namespace {

/// A point in the shape, on its surface every other time.
Vec3 point_in(const CollisionShape& shape, Rng& random) {
  const Vec3 half = shape.half_extents();
  while (true) {
    Vec3 p{random.uniform(-half.x(), half.x()), random.uniform(-half.y(), half.y()),
           random.uniform(-half.z(), half.z())};
    const int axis = static_cast<int>(random.index(3));
    if (random.chance(0.5)) p[axis] = random.chance(0.5) ? half[axis] : -half[axis];
    if (signed_distance(shape, p) <= 0.0) return p;
  }
}

TEST(SphereCover, HoldsEveryPointOfEveryLinkShape) {
  Rng random(1);
  for (const Link& link : shipped_robot().links()) {
    for (const CollisionShape& shape : link.collision) {
      for (const double excess : {0.004, 0.008, 0.03}) {
        const std::vector<Sphere> spheres = cover_with_spheres(shape, excess);
        for (int trial = 0; trial < 500; ++trial) {
          const Vec3 p_link = shape.T_link_shape * point_in(shape, random);
          double best = 1.0;
          for (const Sphere& sphere : spheres)
            best = std::min(best, (p_link - sphere.centre).norm() - sphere.radius_m);
          EXPECT_LE(best, 1e-9) << link.name;
        }
      }
    }
  }
}

/// A ball of points, squeezed to a box; flat where an edge is 0.
CollisionShape pebble(Rng& random, const Vec3& edges) {
  TriangleMesh mesh;
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = Vec3{random.normal(), random.normal(), random.normal()}.normalized();
    mesh.vertices.push_back((p.cwiseProduct(edges) / 2.0).cast<float>());
  }
  for (std::uint32_t i = 2; i < 60; ++i) mesh.triangles.push_back({0, i - 1, i});
  return CollisionShape::of_mesh(mesh, Pose(Eigen::Translation3d(0.1, -0.2, 0.3)), "pebble");
}

TEST(SphereCover, HoldsEveryPointOfAMeshsSolid) {
  Rng random(3);
  for (const Vec3& edges : {Vec3(0.1, 0.12, 0.5), Vec3(0.3, 0.3, 0.3), Vec3(0.4, 0.4, 0.0),
                            Vec3(0.02, 0.5, 0.001), Vec3(1.5, 0.2, 0.4)}) {
    const CollisionShape shape = pebble(random, edges);
    for (const double excess : {0.008, 0.03}) {
      const std::vector<Sphere> spheres = cover_with_spheres(shape, excess);
      EXPECT_LT(spheres.size(), 4000U);
      for (int trial = 0; trial < 300; ++trial) {
        const Vec3 p_link = shape.T_link_shape * point_in(shape, random);
        double best = 1.0;
        for (const Sphere& sphere : spheres)
          best = std::min(best, (p_link - sphere.centre).norm() - sphere.radius_m);
        ASSERT_LE(best, 1e-9) << edges.transpose();
      }
    }
  }
}

TEST(ConvexGap, IsNoMoreThanTheDistanceAndMostOfIt) {
  Rng random(4);
  double share = 0.0;
  int apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const CollisionShape a = pebble(random, Vec3(0.2, 0.1, 0.3));
    const std::vector<CollisionShape> others = {
        pebble(random, Vec3(0.1, 0.1, 0.4)), CollisionShape::box(Vec3(0.1, 0.2, 0.3)),
        CollisionShape::cylinder(0.05, 0.3), CollisionShape::sphere(0.1)};
    for (const CollisionShape& b : others) {
      Pose T = Pose::Identity();
      T.translate(Vec3{random.normal(), random.normal(), random.normal()} * 0.25);
      T.rotate(Eigen::AngleAxisd(random.uniform(0.0, 3.0), Vec3::UnitX()) *
               Eigen::AngleAxisd(random.uniform(0.0, 3.0), Vec3::UnitZ()));
      double distance = 1e300;  // of points of b; those of a's solid come by its planes
      for (int sample = 0; sample < 300; ++sample)
        distance = std::min(distance, std::max(0.0, signed_distance(a, T * point_in(b, random))));
      double nearest = 1e300;  // corners of a from b
      for (const Vec3& corner : a.mesh->corners)
        nearest = std::min(nearest, std::max(0.0, signed_distance(b, T.inverse() * corner)));
      const double gap = convex_gap(a, b, T);
      // Planes give less than the distance, never more; points of one shape give more.
      if (b.kind != ShapeKind::kMesh) {
        EXPECT_LE(gap, nearest + 1e-9);
      }
      EXPECT_NEAR(gap, convex_gap(b, a, T.inverse()), 1e-12);
      if (distance == 0.0) {
        EXPECT_LE(gap, 1e-9);
      }
      if (distance < 0.05) continue;
      ++apart;
      share += gap / distance;
    }
  }
  EXPECT_GT(apart, 60);
  EXPECT_GT(share / apart, 0.7);
}

TEST(SphereCover, SticksOutOfAMantleByNoMoreThanAsked) {
  for (const auto& [radius, length] : {std::pair(0.05, 0.4), std::pair(0.04, 0.1)}) {
    for (const Sphere& sphere :
         cover_with_spheres(CollisionShape::cylinder(radius, length), 0.008)) {
      EXPECT_LE(sphere.radius_m, radius + 0.008 + 1e-12);
    }
  }
}

TEST(SignedDistance, IsTheDistanceToTheNearestPointOfTheShape) {
  Rng random(2);
  for (const CollisionShape& shape :
       {CollisionShape::box(Vec3(0.2, 0.1, 0.05)), CollisionShape::cylinder(0.05, 0.1),
        CollisionShape::sphere(0.07)}) {
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 p{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
      double nearest = 1.0;
      for (int sample = 0; sample < 2000; ++sample)
        nearest = std::min(nearest, (point_in(shape, random) - p).norm());
      const double distance = signed_distance(shape, p);
      EXPECT_LE(std::max(distance, 0.0), nearest + 1e-12);
      if (distance > 0.0) {
        EXPECT_GT(distance, nearest - 0.03);
      }
    }
  }
}

}  // namespace
}  // namespace canopeer
