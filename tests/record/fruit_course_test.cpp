#include "canopeer/record/fruit_course.h"

#include <gtest/gtest.h>

#include "canopeer/record/summary.h"

namespace canopeer {
namespace {

std::vector<FruitSnapshot> fruits(int count) {
  std::vector<FruitSnapshot> all;
  for (int id = 0; id < count; ++id) all.push_back({id, Vec3::Zero(), 50.0, 0.9});
  return all;
}

/// Two views, three frames between and after them.
RunRecord some_record() {
  RunRecord record;
  for (const auto& [t_s, count] : {std::pair(1.0, 1), std::pair(4.0, 3)}) {
    ViewEvent view;
    view.view = static_cast<int>(record.views.size());
    view.t_s = t_s;
    view.fruits = fruits(count);
    record.views.push_back(view);
  }
  for (const auto& [t_s, count] : {std::pair(2.0, 2), std::pair(3.0, 2), std::pair(5.0, 4)}) {
    FrameEvent frame;
    frame.view = t_s < 4.0 ? 1 : 2;  // the first view was before all, the second before the last
    frame.t_s = t_s;
    frame.fruits = fruits(count);
    record.frames.push_back(frame);
  }
  return record;
}

TEST(FruitCourse, TakesViewsAndFramesOnTheWayByTime) {
  const RunRecord record = some_record();
  const std::vector<FruitsAtTime> course = fruit_course(record);
  std::vector<double> times;
  std::vector<std::size_t> counts;
  for (const FruitsAtTime& at : course) {
    times.push_back(at.t_s);
    counts.push_back(at.fruits->size());
  }
  EXPECT_EQ(times, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(counts, (std::vector<std::size_t>{1, 2, 2, 3, 4}));
  EXPECT_EQ(summary_of(record).fruits_reported, 4);
  EXPECT_TRUE(fruit_course({}).empty());
}

TEST(FruitCourse, TellsWhereAFruitWasFirstKnown) {
  const RunRecord record = some_record();
  const auto first = first_known(fruit_course(record));
  ASSERT_EQ(first.size(), 4U);
  EXPECT_FALSE(first.at(0).on_the_way);
  EXPECT_TRUE(first.at(1).on_the_way);
  EXPECT_EQ(first.at(1).t_s, 2.0);
  EXPECT_FALSE(first.at(2).on_the_way);
  EXPECT_TRUE(first.at(3).on_the_way);
}

}  // namespace
}  // namespace canopeer
