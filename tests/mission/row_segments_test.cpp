#include "canopeer/mission/row_segments.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

SegmentPlan stop(double travel_m, double lift_m, int side, double time_s = 0.0) {
  SegmentPlan plan;
  plan.trolley = {travel_m, lift_m};
  plan.side = side;
  plan.name = "stop";
  plan.time_s = time_s;
  return plan;
}

TEST(RowSegments, AllOfOneSideIsOneSegmentWithTheTimeOfAllOfThem) {
  const auto sides = segments_along_row(
      {stop(0, 0, 2), stop(0, 0, 1), stop(0, 0.7, 2), stop(0, 0.7, 1, 4.0), stop(1, 0, 2)}, 10.0);
  ASSERT_EQ(sides.size(), 2U);
  EXPECT_EQ(sides[0].name, "row, side 2");
  EXPECT_EQ(sides[0].side, 2);
  EXPECT_EQ(sides[0].time_s, 30.0);
  EXPECT_EQ(sides[1].name, "row, side 1");
  EXPECT_EQ(sides[1].time_s, 14.0);
  EXPECT_EQ(sides[1].row.size(), 2U);
}

TEST(RowSegments, StopsComeOnceByLiftAndAlongTheRow) {
  const auto sides = segments_along_row(
      {stop(3, 0.7, 1), stop(3, 0, 1), stop(1, 0.7, 1), stop(1, 0, 1), stop(1, 0, 1)}, 10.0);
  ASSERT_EQ(sides.size(), 1U);
  const std::vector<TrolleyState> wanted = {{1, 0}, {3, 0}, {1, 0.7}, {3, 0.7}};
  ASSERT_EQ(sides[0].row.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(sides[0].row[i].travel_m, wanted[i].travel_m);
    EXPECT_EQ(sides[0].row[i].lift_m, wanted[i].lift_m);
  }
  EXPECT_EQ(sides[0].trolley.travel_m, 1.0);
  EXPECT_EQ(sides[0].trolley.lift_m, 0.0);
  EXPECT_EQ(sides[0].time_s, 50.0);
}

TEST(RowSegments, TheViewsOfAllOfThemAreItsViews) {
  const auto sides = segments_along_row({stop(0, 0, 1), stop(1, 0, 1), stop(0, 0, 2)}, 0.0, 10);
  ASSERT_EQ(sides.size(), 2U);
  EXPECT_EQ(sides[0].max_views, 20);
  EXPECT_EQ(sides[1].max_views, 10);
  EXPECT_EQ(sides[0].time_s, 0.0);
}

TEST(RowSegments, OfNothingThereAreNone) { EXPECT_TRUE(segments_along_row({}, 10.0).empty()); }

}  // namespace
}  // namespace canopeer
