#include "canopeer/record/yardstick_shares.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

Yardstick some_yardstick() {
  Yardstick y;
  y.mission = "dense_1";
  y.protocol = "tight10";
  y.world_seed = 3;
  y.fruits_total = 100;
  y.ceiling_fruits = 80;
  y.ceiling_surface = 0.5;
  y.clairvoyant = BestResult{75, 0.6, "clairvoyant", "1", 3, "", {}};
  y.best_found = BestResult{60, 0.3, "vmp", "1", 3, "", {}};
  y.best_auc = BestResult{50, 0.5, "nbs", "1", 3, "", {}};
  y.sampled = UpperBound{78.0, 0.75, {}, "knapsack"};
  y.certified = UpperBound{80.0, {}, {}, "ceiling"};
  return y;
}

TEST(YardstickShares, AreAsWorkedOutByHand) {
  RunScores s;
  s.detected = 60;
  s.auc = 0.3;
  s.roi_surface_coverage = 0.4;
  hold_against(some_yardstick(), s);
  EXPECT_DOUBLE_EQ(s.ceiling_fruits_share.value(), 60.0 / 80.0);
  EXPECT_DOUBLE_EQ(s.ceiling_surface_share.value(), 0.4 / 0.5);
  EXPECT_DOUBLE_EQ(s.clairvoyant_found_share.value(), 60.0 / 75.0);
  EXPECT_DOUBLE_EQ(s.clairvoyant_auc_share.value(), 0.3 / 0.6);
  EXPECT_DOUBLE_EQ(s.best_found_share.value(), 1.0);
  EXPECT_DOUBLE_EQ(s.best_auc_share.value(), 0.3 / 0.5);
  EXPECT_DOUBLE_EQ(s.sampled_found_gap.value(), 18.0 / 78.0);
  EXPECT_DOUBLE_EQ(s.sampled_auc_gap.value(), 0.45 / 0.75);
  EXPECT_DOUBLE_EQ(s.certified_found_gap.value(), 20.0 / 80.0);
  EXPECT_FALSE(s.certified_auc_gap.has_value());  // nobody reckoned it
}

TEST(YardstickShares, OfWhatIsNotKnownAreNull) {
  RunScores nothing_known;
  hold_against(some_yardstick(), nothing_known);
  EXPECT_FALSE(nothing_known.ceiling_fruits_share.has_value());
  EXPECT_FALSE(nothing_known.sampled_found_gap.has_value());
  RunScores s;
  s.detected = 0;
  s.auc = 0.0;
  Yardstick of_nothing = some_yardstick();
  of_nothing.ceiling_fruits = 0;
  of_nothing.clairvoyant->auc = 0.0;
  hold_against(of_nothing, s);
  EXPECT_FALSE(s.ceiling_fruits_share.has_value());
  EXPECT_FALSE(s.clairvoyant_auc_share.has_value());
  EXPECT_DOUBLE_EQ(s.clairvoyant_found_share.value(), 0.0);
  EXPECT_DOUBLE_EQ(s.certified_found_gap.value(), 1.0);
  // Another yardstick leaves nothing of the first behind.
  hold_against(Yardstick{}, s);
  EXPECT_FALSE(s.clairvoyant_found_share.has_value());
}

TEST(YardstickShares, FitOneWorldAndProtocolOnly) {
  const Yardstick y = some_yardstick();
  EXPECT_TRUE(check_fits(y, "dense_1", "tight10", 3, 100));
  EXPECT_TRUE(check_fits(y, "dense_1", "tight10", std::nullopt, std::nullopt));
  const auto says = [](const Expected<void>& fits) {
    return fits ? std::string() : fits.error().message;
  };
  EXPECT_NE(says(check_fits(y, "dense_2", "tight10", 3, 100)).find("'dense_2'"), std::string::npos);
  EXPECT_NE(says(check_fits(y, "dense_1", "", 3, 100)).find("'own'"), std::string::npos);
  EXPECT_NE(says(check_fits(y, "dense_1", "tight10", 4, 100)).find("seed 4"), std::string::npos);
  EXPECT_NE(says(check_fits(y, "dense_1", "tight10", 3, 99)).find("has 99"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
