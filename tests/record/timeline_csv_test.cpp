#include "canopeer/record/timeline_csv.h"

#include <gtest/gtest.h>

#include "canopeer/base/csv_table.h"

namespace canopeer {
namespace {

TEST(TimelineCsv, HasOneRowPerViewAndLeavesAnUnknownGainEmpty) {
  RunRecord record;
  record.views.resize(2);
  record.views[1].view = 1;
  record.views[1].t_s = 2.5;
  record.views[1].target_kind = "roi";
  record.views[1].predicted_gain = 120.0;
  record.views[1].fruits.resize(3);
  record.views[1].pixels = PixelHits{3, 1, 0};
  record.views[1].T_world_camera.translation() = Vec3(0.1, -1.5, 1.0);
  const Expected<CsvTable> table = CsvTable::parse(timeline_csv(record), "timeline.csv");
  ASSERT_TRUE(table.has_value()) << table.error().message;
  ASSERT_EQ(table->rows(), 2U);
  EXPECT_EQ(*table->text(0, "predicted_gain"), "");
  EXPECT_EQ(*table->number(1, "t_s"), 2.5);
  EXPECT_EQ(*table->integer(1, "fruits_found"), 3);
  EXPECT_EQ(*table->text(1, "target_kind"), "roi");
  EXPECT_EQ(*table->number(1, "predicted_gain"), 120.0);
  EXPECT_EQ(*table->number(1, "y_m"), -1.5);
  EXPECT_EQ(*table->text(0, "pixel_iou"), "");
  EXPECT_EQ(*table->number(1, "pixel_precision"), 0.75);
}

}  // namespace
}  // namespace canopeer
