#include "canopeer/fruit/row_place.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

TEST(PlaceInRows, IsTheNearestRowWithSideLengthAndHeight) {
  const std::vector<PlantRow> rows = {{"west", {-0.75, -1.5, 0.0}, Vec3::UnitY()},
                                      {"east", {0.75, -1.5, 0.2}, Vec3::UnitY()}};
  const auto west = place_in_rows(rows, {-0.70, 0.5, 1.1});
  ASSERT_TRUE(west.has_value());
  EXPECT_EQ(west->row, "west");
  EXPECT_EQ(west->side, 'R');  // looking along +y, +x is right
  EXPECT_NEAR(west->along_m, 2.0, 1e-12);
  EXPECT_NEAR(west->height_m, 1.1, 1e-12);
  const auto east = place_in_rows(rows, {0.70, -1.0, 1.1});
  EXPECT_EQ(east->row, "east");
  EXPECT_EQ(east->side, 'L');
  EXPECT_NEAR(east->height_m, 0.9, 1e-12);
}

TEST(PlaceInRows, IsNothingWithoutRows) { EXPECT_FALSE(place_in_rows({}, Vec3::Zero())); }

}  // namespace
}  // namespace canopeer
