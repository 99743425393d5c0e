#include "canopeer/scene/plants/canopy_cover.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

/// A blade that hangs straight down, its flat side to the aisles, its middle at (x, 0, 1).
PlacedLeaf curtain(double x) {
  PlacedLeaf leaf;
  leaf.form.length_m = 0.2;
  leaf.form.width_m = 0.2;
  leaf.form.petiole_m = 0.05;
  leaf.form.blade_pitch_rad = -1.5;
  leaf.form.bend_rad = 0.05;
  leaf.form.azimuth_rad = x > 0.0 ? 0.0 : 3.14159265;
  leaf.node = Vec3(x > 0.0 ? x - 0.05 : x + 0.05, 0.0, 1.1);
  return leaf;
}

TEST(CanopyCover, ALeafBeforeAPlaceHidesItFromItsSideOnly) {
  const Vec3 place(0.0, 0.0, 1.0);
  EXPECT_EQ(CanopyCover({}).shown_level(place, 0.03), 1.0);
  EXPECT_EQ(CanopyCover({curtain(0.07)}).shown_level(place, 0.03), 1.0);
  EXPECT_EQ(CanopyCover({curtain(0.07), curtain(-0.07)}).shown_level(place, 0.03), 0.0);
  // Far above the leaves nothing hides.
  EXPECT_EQ(CanopyCover({curtain(0.07), curtain(-0.07)}).shown_level(Vec3(0, 0, 1.4), 0.03), 1.0);
}

TEST(CanopyCover, ALeafThatWouldCutTheBodyDoesNotCount) {
  const CanopyCover cover({curtain(0.02), curtain(-0.07)});
  EXPECT_EQ(cover.shown_level(Vec3(0.0, 0.0, 1.0), 0.03), 1.0);
}

}  // namespace
}  // namespace canopeer
