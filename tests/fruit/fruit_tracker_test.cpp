#include "canopeer/fruit/instances/fruit_tracker.h"

#include <gtest/gtest.h>

#include <numeric>

namespace canopeer {
namespace {

TrackedFruit fruit(const Vec3& centre, std::uint64_t first_cell, int cells) {
  TrackedFruit f{-1, centre, std::vector<std::uint64_t>(static_cast<std::size_t>(cells))};
  std::iota(f.cells.begin(), f.cells.end(), first_cell);
  return f;
}

class FruitTrackerTest : public ::testing::Test {
 protected:
  /// The next update: these come in place of those of the last.
  const std::vector<TrackedFruit>& see(std::vector<TrackedFruit> found) {
    tracker_.assign(found, now_);
    now_ = std::move(found);
    return now_;
  }
  FruitTracker tracker_{0.05};
  std::vector<TrackedFruit> now_;
};

TEST_F(FruitTrackerTest, GivesNewFruitsNumbersInOrder) {
  see({fruit({0, 0, 0}, 0, 100), fruit({1, 0, 0}, 1000, 100)});
  EXPECT_EQ(now_[0].id, 0);
  EXPECT_EQ(now_[1].id, 1);
}

TEST_F(FruitTrackerTest, KeepsTheIdWithTheSurfaceThoughTheCentreMoves) {
  see({fruit({0, 0, 0}, 0, 100), fruit({0.07, 0, 0}, 1000, 100)});
  // Both centres jump, each nearer to where the other was; the surface tells who is who.
  see({fruit({0.02, 0, 0}, 1000, 120), fruit({0.05, 0, 0}, 0, 130)});
  EXPECT_EQ(now_[0].id, 1);
  EXPECT_EQ(now_[1].id, 0);
  EXPECT_TRUE(tracker_.changes().empty());
}

TEST_F(FruitTrackerTest, MergesIntoTheOneThatSharesMore) {
  see({fruit({0, 0, 0}, 0, 60), fruit({0.03, 0, 0}, 100, 200)});
  see({fruit({0.02, 0, 0}, 0, 300)});
  EXPECT_EQ(now_[0].id, 1);
  ASSERT_EQ(tracker_.changes().size(), 1U);
  EXPECT_EQ(tracker_.changes()[0].kind, IdChange::Kind::merged);
  EXPECT_EQ(tracker_.changes()[0].id, 0);
  EXPECT_EQ(tracker_.changes()[0].other, 1);
}

TEST_F(FruitTrackerTest, LeavesTheIdWithTheLargerPartOfASplit) {
  see({fruit({0, 0, 0}, 0, 300)});
  see({fruit({-0.03, 0, 0}, 0, 100), fruit({0.03, 0, 0}, 100, 200)});
  EXPECT_EQ(now_[1].id, 0);
  EXPECT_EQ(now_[0].id, 1);
  ASSERT_EQ(tracker_.changes().size(), 1U);
  EXPECT_EQ(tracker_.changes()[0].kind, IdChange::Kind::split);
  EXPECT_EQ(tracker_.changes()[0].id, 1);
  EXPECT_EQ(tracker_.changes()[0].other, 0);
}

TEST_F(FruitTrackerTest, GivesALostFruitItsIdBackWhereItWas) {
  see({fruit({0, 0, 0}, 0, 100)});
  see({});
  see({fruit({0.5, 0, 0}, 500, 100), fruit({0.01, 0, 0}, 900, 100)});
  EXPECT_EQ(now_[0].id, 1);
  EXPECT_EQ(now_[1].id, 0);
}

}  // namespace
}  // namespace canopeer
