#include "canopeer/geometry/pose.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

Vec3 random_point(Rng& rng) { return {rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)}; }

TEST(LookAt, PutsTheTargetOnTheOpticalAxisWithTheImageUpright) {
  Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 position = random_point(rng);
    const Vec3 target = random_point(rng);
    const Pose T = look_at(position, target);
    const Vec3 seen = T.inverse() * target;
    EXPECT_NEAR(seen.x(), 0.0, 1e-12);
    EXPECT_NEAR(seen.y(), 0.0, 1e-12);
    EXPECT_NEAR(seen.z(), (target - position).norm(), 1e-12);
    EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
    EXPECT_NEAR(T.linear()(2, 0), 0.0, 1e-12);  // image x is level
    EXPECT_LE(T.linear()(2, 1), 1e-12);         // image y points down
  }
}

TEST(LookAt, WorksStraightDownAndWithRoll) {
  const Pose down = look_at(Vec3(0, 0, 1), Vec3(0, 0, 0));
  EXPECT_TRUE(down.linear().col(2).isApprox(-Vec3::UnitZ()));
  const Pose level = look_at(Vec3::Zero(), Vec3::UnitX());
  const Pose rolled = look_at(Vec3::Zero(), Vec3::UnitX(), 1.5707963267948966);
  EXPECT_TRUE(rolled.linear().col(0).isApprox(level.linear().col(1), 1e-12));
}

TEST(Transformed, BoxHoldsAllItsMappedPoints) {
  Rng rng(4);
  const Box box(Vec3(-1, 0, 2), Vec3(1, 3, 4));
  const Pose T = look_at(random_point(rng), random_point(rng), 0.3);
  const Box mapped = transformed(box, T);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{rng.uniform(-1, 1), rng.uniform(0, 3), rng.uniform(2, 4)};
    EXPECT_LT(mapped.exteriorDistance(T * p), 1e-12);
  }
}

}  // namespace
}  // namespace canopeer
