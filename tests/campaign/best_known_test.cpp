#include "canopeer/campaign/best_known.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

RunFigures run(int detected, double auc) {
  RunFigures figures_of_run;
  figures_of_run.job.contestant.planner = "vmp";
  figures_of_run.job.seed = 4;
  figures_of_run.values.resize(figures().size());
  figures_of_run.values[figure_index("detected")] = detected;
  figures_of_run.values[figure_index("auc")] = auc;
  return figures_of_run;
}

Yardstick known(int detected, double auc) {
  Yardstick yardstick;
  yardstick.fruits_total = 20;
  yardstick.best_found = BestResult{};
  yardstick.best_found->detected = detected;
  yardstick.best_found->auc = auc;
  yardstick.best_auc = yardstick.best_found;
  return yardstick;
}

TEST(BestKnown, IsBeatenByMoreFruitsOrAGreaterAuc) {
  const Yardstick yardstick = known(10, 0.5);
  EXPECT_FALSE(improved_by(yardstick, run(10, 0.5), "9").has_value());
  EXPECT_FALSE(improved_by(yardstick, run(9, 0.4), "9").has_value());
  const auto more = improved_by(yardstick, run(11, 0.4), "9");
  ASSERT_TRUE(more.has_value());
  EXPECT_EQ(more->best_found->detected, 11);
  EXPECT_EQ(more->best_found->planner, "vmp");
  EXPECT_EQ(more->best_found->seed, 4U);
  EXPECT_EQ(more->best_found->version, "9");
  EXPECT_EQ(more->best_auc->auc, 0.5);
  const auto sooner = improved_by(yardstick, run(10, 0.6), "9");
  ASSERT_TRUE(sooner.has_value());
  EXPECT_EQ(sooner->best_found->auc, 0.6);  // as many fruits, sooner
  EXPECT_EQ(sooner->best_auc->auc, 0.6);
  EXPECT_TRUE(improved_by(Yardstick{}, run(0, 0.0), "9").has_value());
}

TEST(BestKnown, OfTwoYardsticksTheBetterResultsStay) {
  Yardstick found = known(10, 0.5);
  found.ceiling_fruits = 15;
  Yardstick older = known(9, 0.6);
  older.best_auc->plan = "older";
  older.clairvoyant = older.best_auc;
  const Yardstick both = with_better_of(found, older);
  EXPECT_EQ(both.best_found->detected, 10);
  EXPECT_EQ(both.best_auc->auc, 0.6);
  EXPECT_EQ(both.best_auc->plan, "older");
  EXPECT_EQ(both.clairvoyant->auc, 0.6);
  EXPECT_EQ(both.ceiling_fruits, 15);
  // Equals stay as they are.
  EXPECT_EQ(with_better_of(known(10, 0.5), known(10, 0.5)).best_auc->plan, "");
  EXPECT_FALSE(with_better_of(Yardstick{}, Yardstick{}).best_found.has_value());
}

TEST(BestKnown, ContradictionsAreNamed) {
  EXPECT_TRUE(contradictions(known(10, 0.5)).empty());
  Yardstick bounded = known(10, 0.5);
  bounded.certified = UpperBound{12.0, 0.6, {}, "lp"};
  bounded.sampled = UpperBound{11.0, 0.55, {}, "lp"};
  EXPECT_TRUE(contradictions(bounded).empty());
  bounded.sampled->fruits = 9.0;
  EXPECT_EQ(contradictions(bounded).size(), 1U);
  bounded.certified->auc = 0.4;
  EXPECT_EQ(contradictions(bounded).size(), 2U);
  Yardstick unbeaten = known(10, 0.5);
  unbeaten.clairvoyant = unbeaten.best_found;
  EXPECT_TRUE(contradictions(unbeaten).empty());
  unbeaten.clairvoyant->auc = 0.7;
  EXPECT_EQ(contradictions(unbeaten).size(), 1U);
  EXPECT_FALSE(contradictions(known(21, 0.5)).empty());
}

TEST(BestKnown, RecordsLieByMissionSeedAndProtocol) {
  EXPECT_EQ(mission_record("dense_1", 3, "tight10"), "dense_1/seed_3/tight10.json");
  EXPECT_EQ(suite_record("sparse_1_clean_a", "views10"), "suite/sparse_1_clean_a/views10.json");
}

}  // namespace
}  // namespace canopeer
