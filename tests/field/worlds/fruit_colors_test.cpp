#include "canopeer/run/fruit_colors.h"

#include <gtest/gtest.h>

#include "field_meshes.h"

namespace canopeer {
namespace {

/// A world of one cube whose picture is `picture`; empty: it is not there.
Scene cube_with(const std::string& picture) {
  const test::WorldFiles files;
  files.add("fruit.mtl", "newmtl fruit\nmap_Kd fruit.tga\n");
  if (!picture.empty()) files.add("fruit.tga", picture);
  auto read =
      test::import_all_as_fruit(files.add("fruit.obj", test::cube_obj("fruit", "fruit.mtl")));
  EXPECT_EQ(read.error, "");
  return std::move(read.world.scene);
}

TEST(FieldFruitColors, RedIsSeenAndNothingIsSaid) {
  const Scene scene = cube_with(test::tga({200, 30, 10}));
  const FruitColors colors = look_at_fruits(scene, {});
  EXPECT_EQ(colors.counted, 1);
  EXPECT_EQ(colors.seen, 1);
  EXPECT_EQ(colors.colorless, 0);
  EXPECT_DOUBLE_EQ(colors.passing, 1.0);
  EXPECT_FALSE(fruit_color_notice(scene, {}).has_value());
}

TEST(FieldFruitColors, CapitalsInAPicturesNameDoNotMatter) {
  const test::WorldFiles files;
  files.add("fruit.mtl", "newmtl fruit\nmap_Kd C:\\models\\FRUIT.tga\n");
  files.add("textures/Fruit.TGA", test::tga({200, 30, 10}));
  const auto read =
      test::import_all_as_fruit(files.add("fruit.obj", test::cube_obj("fruit", "fruit.mtl")));
  EXPECT_EQ(read.error, "");
  EXPECT_EQ(look_at_fruits(read.world.scene, {}).seen, 1);
}

TEST(FieldFruitColors, AMissingPictureIsSaidWithNumbers) {
  const auto notice = fruit_color_notice(cube_with(""), {});
  ASSERT_TRUE(notice.has_value());
  EXPECT_NE(notice->find("of 1 fruits that count, the detector 'colour' can see 0: 0.0 % of their "
                         "surface has a colour it looks for, and 1 fruits are grey or white"),
            std::string::npos)
      << *notice;
}

TEST(FieldFruitColors, WhatIsSeenDependsOnTheDetector) {
  const Scene scene = cube_with(test::tga({220, 210, 20}));  // a yellow pepper
  const auto notice = fruit_color_notice(scene, {});
  ASSERT_TRUE(notice.has_value());
  EXPECT_EQ(notice->find("grey or white"), std::string::npos);
  ColorDetectorOptions yellow;
  yellow.windows = {{PixelLabel::ripe_fruit, 40.0, 70.0, 0.6, 0.16, 0.5}};
  EXPECT_FALSE(fruit_color_notice(scene, yellow).has_value());
  yellow.windows.front().label = PixelLabel::green_fruit;  // does not count
  EXPECT_TRUE(fruit_color_notice(scene, yellow).has_value());
}

TEST(FieldFruitColors, OfAWorldWithoutFruitsNothingIsSaid) {
  EXPECT_FALSE(fruit_color_notice(Scene(), {}).has_value());
}

}  // namespace
}  // namespace canopeer
