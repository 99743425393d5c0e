#include "canopeer/render/overview.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

TEST(Overview, ShowsThePlantsAndTheirFruits) {
  const ColorImage image = render_overview(make_world(scenario_1_world(), 1), 320, 180);
  ASSERT_EQ(image.width(), 320);
  ASSERT_EQ(image.height(), 180);
  const auto count = [&](auto&& is) {
    return std::count_if(image.pixels().begin(), image.pixels().end(), is);
  };
  // Green and red as no floor or wall is.
  EXPECT_GT(count([](const Rgb& c) { return c.g > c.r + 15 && c.g > c.b + 15; }), 1500);
  EXPECT_GT(count([](const Rgb& c) { return c.r > c.g + 80 && c.r > 120; }), 100);
}

TEST(Overview, CutsNoPlantOff) {
  // A lone red mast on nothing: all of it must be inside the picture, and fill most of its height.
  Scene scene;
  ScenePart mast;
  mast.mesh = make_box(Box(Vec3(-0.2, -0.2, 0.0), Vec3(0.2, 0.2, 2.5)));
  compute_normals(mast.mesh);
  mast.kind = PartClass::stem;
  mast.plant = 0;
  mast.color = {220, 20, 20};
  scene.parts.push_back(mast);
  const ColorImage image = render_overview(scene, 320, 180);
  int top = image.height();
  int bottom = -1;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const Rgb& c = image.at(u, v);
      if (c.r < c.g + 60) continue;
      top = std::min(top, v);
      bottom = std::max(bottom, v);
    }
  }
  EXPECT_GT(top, 0);
  EXPECT_LT(bottom, image.height() - 1);
  EXPECT_GT(bottom - top, 150);
}

}  // namespace
}  // namespace canopeer
