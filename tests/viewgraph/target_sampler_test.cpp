#include "canopeer/viewgraph/target_sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace canopeer {
namespace {

FrontierTargets targets(int roi, int occupied, int border) {
  FrontierTargets t;
  for (int i = 0; i < roi; ++i) t.roi.emplace_back(i, 0, 0);
  for (int i = 0; i < occupied; ++i) t.occupied.emplace_back(i, 1, 0);
  for (int i = 0; i < border; ++i) t.border.emplace_back(i, 2, 0);
  return t;
}

std::map<TargetKind, int> draw_many(const TargetSampler& sampler, int draws) {
  Rng rng(1);
  std::map<TargetKind, int> counts;
  for (int i = 0; i < draws; ++i) ++counts[sampler.draw_kind(rng).value()];
  return counts;
}

TEST(TargetSampler, DrawsTheKindsByTheirShares) {
  auto counts = draw_many(TargetSampler(targets(3, 1000, 20), 0.01, {}), 20000);
  EXPECT_NEAR(counts[TargetKind::roi], 10000, 5 * 71);  // √(n·p·(1−p))
  EXPECT_NEAR(counts[TargetKind::occupied], 6000, 5 * 65);
  EXPECT_NEAR(counts[TargetKind::border], 4000, 5 * 57);
}

TEST(TargetSampler, AnEmptyKindHandsOverToTheNext) {
  auto no_roi = draw_many(TargetSampler(targets(0, 10, 10), 0.01, {}), 10000);
  EXPECT_EQ(no_roi[TargetKind::roi], 0);
  EXPECT_NEAR(no_roi[TargetKind::occupied], 8000, 5 * 40);
  auto only_roi = draw_many(TargetSampler(targets(5, 0, 0), 0.01, {}), 1000);
  EXPECT_EQ(only_roi[TargetKind::roi], 1000);
}

TEST(TargetSampler, AClosedKindHandsOverToo) {
  TargetSampler sampler(targets(5, 10, 10), 0.01, {});
  sampler.close(TargetKind::occupied, true);
  auto counts = draw_many(sampler, 10000);
  EXPECT_EQ(counts[TargetKind::occupied], 0);
  EXPECT_NEAR(counts[TargetKind::border], 5000, 5 * 50);
  sampler.close(TargetKind::roi, true);
  sampler.close(TargetKind::border, true);
  EXPECT_TRUE(sampler.empty());
  Rng rng(3);
  EXPECT_FALSE(sampler.draw_kind(rng).has_value());
  sampler.close(TargetKind::occupied, false);
  EXPECT_EQ(sampler.draw_kind(rng), TargetKind::occupied);
}

TEST(TargetSampler, GivesVoxelCentresAndNothingWhenThereIsNone) {
  Rng rng(2);
  const TargetSampler one(targets(1, 0, 0), 0.01, {});
  EXPECT_TRUE(one.draw(TargetKind::roi, rng).p_world.isApprox(Vec3(0.005, 0.005, 0.005)));
  EXPECT_FALSE(TargetSampler(FrontierTargets{}, 0.01, {}).draw_kind(rng).has_value());
}

TEST(TargetSampler, WeighsTheTargetsOfAKind) {
  // Voxel 0 is out of reach, voxel 2 weighs three times as much as voxel 1.
  const TargetSampler sampler(targets(3, 0, 0), 1.0, {}, [](const Vec3& p) {
    return p.x() < 1.0 ? 0.0 : p.x() < 2.0 ? 1.0 : 3.0;
  });
  Rng rng(4);
  std::array<int, 3> drawn{};
  for (int i = 0; i < 20000; ++i) {
    ++drawn[static_cast<std::size_t>(sampler.draw(TargetKind::roi, rng).p_world.x())];
  }
  EXPECT_EQ(drawn[0], 0);
  EXPECT_NEAR(drawn[2], 15000, 5 * 61);
  EXPECT_TRUE(TargetSampler(targets(5, 5, 5), 0.01, {}, [](const Vec3&) { return 0.0; }).empty());
}

}  // namespace
}  // namespace canopeer
