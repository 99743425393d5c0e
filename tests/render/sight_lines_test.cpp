#include "canopeer/render/sight_lines.h"

#include <gtest/gtest.h>

#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {
namespace {

/// A board at x = 1, and one of glass at x = 2.
std::vector<NumberedPart> two_boards() {
  NumberedPart wood;
  wood.part.mesh = make_box(Box(Vec3(1.0, -1.0, 0.0), Vec3(1.02, 1.0, 1.0)));
  NumberedPart glass;
  glass.part.mesh = make_box(Box(Vec3(2.0, -1.0, 0.0), Vec3(2.02, 1.0, 1.0)));
  glass.part.see_through = true;
  return {wood, glass};
}

TEST(SightLines, EndAtWhatIsSolidAndPassThroughGlass) {
  const SightLines lines(two_boards());
  EXPECT_FALSE(lines.clear({0.0, 0.0, 0.5}, {1.5, 0.0, 0.5}));
  EXPECT_TRUE(lines.clear({1.5, 0.0, 0.5}, {3.0, 0.0, 0.5}));
  EXPECT_TRUE(lines.clear({0.0, 0.0, 1.5}, {3.0, 0.0, 1.5}));
  EXPECT_FALSE(lines.clear({0.0, 0.0, 1.2}, {1.4, 0.0, 0.6}));
}

TEST(SightLines, ASurfaceDoesNotHideItself) {
  const SightLines lines(two_boards());
  EXPECT_TRUE(lines.clear({0.0, 0.3, 0.2}, {1.0, 0.1, 0.5}));
  EXPECT_FALSE(lines.clear({0.0, 0.3, 0.2}, {1.02, 0.1, 0.5}));  // its back
  EXPECT_TRUE(lines.clear({1.0, 0.1, 0.5}, {1.0, 0.1, 0.5}));
}

}  // namespace
}  // namespace canopeer
