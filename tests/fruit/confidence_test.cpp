#include "canopeer/fruit/confidence/confidence.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

/// A fruit half of which was seen, so-so.
FruitEvidence so_so() {
  FruitEvidence e;
  e.area_cm2 = 30.0;
  e.seen_share = 0.2;
  e.rms_m = 0.0015;
  e.size_sds = 1.0;
  e.normal_spread = 0.2;
  e.foreign_share = 0.1;
  e.free_share = 0.05;
  e.fruit_share = 0.8;
  e.views = 3;
  return e;
}

TEST(ConfidenceModel, IsAProbabilityWhateverTheEvidence) {
  const ConfidenceModel model;
  FruitEvidence worst;
  worst.rms_m = worst.size_sds = 1e9;
  worst.foreign_share = worst.free_share = 1.0;
  FruitEvidence best;
  best.area_cm2 = 1e9;
  best.seen_share = best.normal_spread = 1.0;
  for (const FruitEvidence& e : {FruitEvidence{}, worst, best, so_so()}) {
    EXPECT_GE(model(e), 0.0);
    EXPECT_LE(model(e), 1.0);
  }
  EXPECT_LT(model(worst), 0.01);
  EXPECT_GT(model(best), 0.99);
}

TEST(ConfidenceModel, GoesUpWithWhatSpeaksForAFruitAndDownWithWhatSpeaksAgainst) {
  const ConfidenceModel model;
  const double before = model(so_so());
  const auto with = [&](auto change) {
    FruitEvidence e = so_so();
    change(e);
    return model(e);
  };
  EXPECT_GT(with([](FruitEvidence& e) { e.area_cm2 *= 1.5; }), before);
  EXPECT_GT(with([](FruitEvidence& e) { e.seen_share += 0.1; }), before);
  EXPECT_GT(with([](FruitEvidence& e) { e.normal_spread += 0.1; }), before);
  EXPECT_LT(with([](FruitEvidence& e) { e.rms_m += 0.001; }), before);
  EXPECT_LT(with([](FruitEvidence& e) { e.size_sds += 0.5; }), before);
  EXPECT_LT(with([](FruitEvidence& e) { e.foreign_share += 0.1; }), before);
  EXPECT_LT(with([](FruitEvidence& e) { e.free_share += 0.05; }), before);
}

TEST(ConfidenceModel, IsNotLowerForBeingLookedAtOftener) {
  const ConfidenceModel model;
  FruitEvidence often = so_so();
  often.views = 100;
  EXPECT_GE(model(often), model(so_so()));
}

}  // namespace
}  // namespace canopeer
