#include "canopeer/robot/sphere_cover.h"

#include "robot_fixture.h"

namespace canopeer {
namespace {

/// A point in the shape, on its surface every other time.
Vec3 point_in(const CollisionShape& shape, Rng& random) {
  const Vec3 half = shape.half_extents();
  while (true) {
    Vec3 p(random.uniform(-half.x(), half.x()), random.uniform(-half.y(), half.y()),
           random.uniform(-half.z(), half.z()));
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
      const Vec3 p(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
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
