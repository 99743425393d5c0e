#include "canopeer/render/overview.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/scene/row_world.h"

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

}  // namespace
}  // namespace canopeer
