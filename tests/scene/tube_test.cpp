#include "canopeer/scene/plants/tube.h"

#include <gtest/gtest.h>

#include <numbers>

namespace canopeer {
namespace {

TEST(Tube, HasTheVolumeOfAPrism) {
  const TriangleMesh tube =
      make_tube({{Vec3(0, 0, 0), 0.1}, {Vec3(0, 0, 0.5), 0.1}, {Vec3(0, 0, 1), 0.1}}, 24);
  const double base = 0.5 * 24 * 0.01 * std::sin(2.0 * std::numbers::pi / 24);
  EXPECT_NEAR(tube.volume(), base, 1e-6);  // positive: the triangles look outwards
}

}  // namespace
}  // namespace canopeer
