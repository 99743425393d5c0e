#include "canopeer/eval/metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace canopeer {
namespace {

std::vector<FruitTruth> four_fruits() {
  std::vector<FruitTruth> truth(5);
  for (int i = 0; i < 5; ++i) {
    truth[i].id = i;
    truth[i].centre = {1.0 * i, 0, 0.5};
    truth[i].volume_cm3 = 100.0;
  }
  truth[4].counted = false;
  return truth;
}

FruitEstimate estimate_at(const Vec3& centre, double volume_cm3) {
  FruitEstimate estimate;
  estimate.centre = centre;
  estimate.volume_cm3 = volume_cm3;
  return estimate;
}

ViewEvent view_at(double t_s, const std::vector<Vec3>& centres) {
  ViewEvent view;
  view.t_s = t_s;
  view.planning_s = 0.5;
  for (const Vec3& centre : centres) view.fruits.push_back({0, centre, 100.0});
  return view;
}

RunRecord run() {
  RunRecord record;
  record.end_s = 10.0;
  record.views = {view_at(0.0, {}), view_at(2.0, {{0, 0, 0.5}}),
                  view_at(4.0, {{0, 0, 0.5}, {1, 0, 0.54}}),
                  view_at(8.0, {{0, 0, 0.5}, {1, 0, 0.54}, {2, 0, 0.4}})};
  MotionEvent motion;
  motion.duration_s = 1.5;
  motion.joint_path_rad = 2.0;
  record.motions = {motion, motion, motion};
  record.motions[1].collision = true;
  record.motions[2].plant_contact = true;
  return record;
}

TEST(Metrics, OfAHandMadeRunAreAsWorkedOutByHand) {
  const std::vector<FruitEstimate> fruits = {
      estimate_at({0, 0, 0.5}, 110.0), estimate_at({1, 0, 0.54}, 40.0),
      estimate_at({2, 0, 0.4}, 80.0), estimate_at({4, 0, 0.5}, 50.0),
      estimate_at({9, 0, 0.5}, 100.0)};
  const RunMetrics m = compute_metrics(run(), fruits, four_fruits());
  EXPECT_EQ(m.fruits_total, 4);
  EXPECT_EQ(m.detected, 2);
  EXPECT_EQ(m.detected_paper, 3);
  EXPECT_EQ(m.ma50, 2);                   // 110 and 80 of 100; 40 is too small
  EXPECT_EQ(m.false_positives, 2);        // 0.10 m off, and the one at x = 9
  EXPECT_EQ(m.false_positives_paper, 1);  // the green one's estimate is set aside
  EXPECT_NEAR(*m.volume_error_mean, (0.1 + 0.6) / 2, 1e-12);
  EXPECT_NEAR(*m.centre_error_mean_m, 0.02, 1e-12);
  EXPECT_DOUBLE_EQ(*m.time_to_50pct_s, 4.0);
  EXPECT_FALSE(m.time_to_80pct_s.has_value());
  EXPECT_NEAR(*m.auc, (2 * 0 + 2 * 1 + 6 * 2) / (10.0 * 4.0), 1e-12);
  EXPECT_DOUBLE_EQ(m.joint_path_length_rad, 6.0);
  EXPECT_DOUBLE_EQ(m.motion_time_s, 4.5);
  EXPECT_DOUBLE_EQ(m.planning_time_s, 2.0);
  EXPECT_EQ(m.collisions, 1);
  EXPECT_EQ(m.plant_contacts, 1);
  ASSERT_EQ(m.found.size(), 4U);
  EXPECT_EQ(m.found[3].detected, 2);
  EXPECT_EQ(m.found[3].detected_paper, 3);
  EXPECT_FALSE(m.roi_surface_coverage.has_value());
}

TEST(Metrics, OfCountAndVolumeSayWhatTheyAreOver) {
  const std::vector<FruitEstimate> fruits = {
      estimate_at({0, 0, 0.5}, 110.0), estimate_at({1, 0, 0.54}, 40.0),
      estimate_at({4, 0, 0.5}, 50.0),  // of a green fruit: neither right nor wrong
      estimate_at({9, 0, 0.5}, 100.0)};
  const RunMetrics m = compute_metrics(run(), fruits, four_fruits());
  EXPECT_NEAR(m.count_accuracy_pct.value(), 75.0, 1e-12);  // three of four, whichever they are
  EXPECT_NEAR(m.volume_ratio_pct.value(), 100.0 * (110.0 + 40.0) / 200.0, 1e-12);
  const RunMetrics blind = compute_metrics(run(), {}, four_fruits());
  EXPECT_NEAR(blind.count_accuracy_pct.value(), 0.0, 1e-12);
  EXPECT_FALSE(blind.volume_ratio_pct.has_value());
  EXPECT_FALSE(compute_metrics(run(), fruits, {}).count_accuracy_pct.has_value());
}

TEST(Metrics, WithoutATimeLimitAreOverViews) {
  RunRecord record = run();  // sees 0, 1, 2, 2 fruits within 0.05 m
  record.header.segment_time_s = 0.0;
  record.header.segments = 2;
  record.header.views_planned = 6;
  record.segments.resize(2);
  record.segments[0].end_s = 3.0;
  record.segments[1] = record.segments[0];
  record.segments[1].segment = 1;
  record.segments[1].start_s = 3.5;
  record.segments[1].end_s = 9.0;
  record.views[2].segment = record.views[3].segment = 1;
  const RunMetrics m = compute_metrics(record, {}, four_fruits());
  EXPECT_FALSE(m.auc.has_value());
  // Views 0, 1 and one not taken; views 2, 2 and one not taken.
  EXPECT_NEAR(m.auc_views.value(), (0 + 1 + 1 + 2 + 2 + 2) / (6.0 * 4.0), 1e-12);
  record.segments.resize(1);  // ended early: what is not begun keeps the last count
  record.views.resize(2);
  EXPECT_NEAR(compute_metrics(record, {}, four_fruits()).auc_views.value(),
              (0 + 1 + 1 + 3 * 1) / (6.0 * 4.0), 1e-12);
  record.header.views_planned = 0;
  EXPECT_FALSE(compute_metrics(record, {}, four_fruits()).auc_views.has_value());
}

TEST(Metrics, OfWhatWasSeenWeighFruitsByTheirSurfaceAndClipShares) {
  std::vector<FruitTruth> truth = four_fruits();
  for (int i = 0; i < 5; ++i) truth[i].surface_cm2 = i == 0 ? 300.0 : 100.0;
  const std::vector<FruitEstimate> fruits = {estimate_at({0, 0, 0.53}, 110.0),
                                             estimate_at({1, 0, 0.5}, 150.0)};
  // More than all cannot be seen; the green fruit's share does not count.
  const std::vector<double> coverage = {1.2, 0.4, 0.0, 0.5, 1.0};
  const RunMetrics m = compute_metrics(RunRecord{}, fruits, truth, coverage);
  EXPECT_NEAR(*m.roi_surface_coverage, (300.0 + 40.0 + 0.0 + 50.0) / 600.0, 1e-12);
  EXPECT_EQ(m.fruits_half_seen, 1);
  // A distance, not its square: the published evaluator mixes them up.
  EXPECT_NEAR(*m.centre_error_half_seen_m, 0.03, 1e-12);
  EXPECT_NEAR(*m.volume_error_half_seen, 0.1, 1e-12);
}

TEST(Metrics, OfFruitsSeenToThirtyPercentSetTheOthersAside) {
  const std::vector<FruitTruth> truth = four_fruits();
  // Found: 0 and 1; 1 was hardly seen, 2 was seen and missed; one estimate is nowhere near a fruit.
  const std::vector<FruitEstimate> fruits = {estimate_at({0, 0, 0.53}, 110.0),
                                             estimate_at({1, 0, 0.5}, 150.0),
                                             estimate_at({9, 0, 0.5}, 150.0)};
  const std::vector<double> coverage = {0.6, 0.2, 0.3, 0.0, 1.0};
  const RunMetrics m = compute_metrics(RunRecord{}, fruits, truth, coverage);
  EXPECT_EQ(m.fruits_seen_30pct, 2);
  EXPECT_EQ(m.detected_seen_30pct, 1);
  EXPECT_NEAR(*m.f1_seen_30pct, 2.0 * 1.0 / (1.0 + 2.0 + 1.0), 1e-12);
  const std::vector<double> nothing(truth.size(), 0.0);
  const RunMetrics blind = compute_metrics(RunRecord{}, {}, truth, nothing);
  EXPECT_EQ(blind.fruits_seen_30pct, 0);
  EXPECT_FALSE(blind.f1_seen_30pct.has_value());
  EXPECT_FALSE(compute_metrics(RunRecord{}, fruits, truth).fruits_seen_30pct.has_value());
}

TEST(Metrics, OfPixelsAreOverAllFramesThatHadLabels) {
  RunRecord record = run();
  EXPECT_FALSE(compute_metrics(record, {}, four_fruits()).pixel_iou.has_value());
  record.views[0].pixels = PixelHits{80, 20, 0};
  record.views[2].pixels = PixelHits{10, 0, 90};
  const RunMetrics m = compute_metrics(record, {}, four_fruits());
  ASSERT_TRUE(m.pixel_iou.has_value());
  EXPECT_NEAR(*m.pixel_precision, 90.0 / 110.0, 1e-12);
  EXPECT_NEAR(*m.pixel_recall, 90.0 / 180.0, 1e-12);
  EXPECT_NEAR(*m.pixel_iou, 90.0 / 200.0, 1e-12);
  EXPECT_EQ(PixelHits{}.iou(), 1.0);
}

TEST(Metrics, OfARunThatFoundNothingHaveNoNaN) {
  for (const auto& truth : {std::vector<FruitTruth>{}, four_fruits()}) {
    const RunMetrics m = compute_metrics(RunRecord{}, {}, truth);
    EXPECT_EQ(m.detected, 0);
    EXPECT_EQ(m.ma50, 0);
    EXPECT_DOUBLE_EQ(m.auc.value(), 0.0);
    EXPECT_FALSE(m.time_to_50pct_s.has_value());
    EXPECT_FALSE(m.volume_error_mean.has_value());
    EXPECT_FALSE(m.centre_error_mean_m.has_value());
  }
}

}  // namespace
}  // namespace canopeer
