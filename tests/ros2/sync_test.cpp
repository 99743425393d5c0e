// What belongs together by time: jitter, drops, rates, order, bounds.
#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/base/rng.h"
#include "canopeer/ros2/camera/clock_difference.h"
#include "canopeer/ros2/camera/frame_sync.h"

namespace canopeer::ros {
namespace {

constexpr Stamp kMs = 1'000'000;
constexpr Stamp kStart = 1000 * kNanosecondsPerSecond;

/// Items are their own stamps.
struct Bench {
  explicit Bench(std::size_t streams, FrameSyncOptions options = {}) : sync(streams, options) {}
  void add(std::size_t stream, Stamp ms) {
    for (auto& set : sync.add(stream, kStart + ms * kMs, ms, 1)) sets.push_back(set.items);
  }
  FrameSync<Stamp> sync;
  std::vector<std::vector<Stamp>> sets;
};

using Sets = std::vector<std::vector<Stamp>>;

TEST(FrameSync, EqualStampsMakeASetAtOnce) {
  Bench bench(2);
  bench.add(0, 0);
  bench.add(1, 0);
  EXPECT_EQ(bench.sets, (Sets{{0, 0}}));
  bench.add(1, 33);
  bench.add(0, 33);
  EXPECT_EQ(bench.sets, (Sets{{0, 0}, {33, 33}}));
}

TEST(FrameSync, TheNearestIsTaken) {
  Bench bench(2);
  bench.add(1, -12);
  bench.add(0, 0);
  EXPECT_TRUE(bench.sets.empty());  // a nearer one may come
  bench.add(1, 5);
  EXPECT_EQ(bench.sets, (Sets{{0, 5}}));
}

TEST(FrameSync, WhatComesAtAPaceIsNotWaitedFor) {
  Bench bench(2);
  for (Stamp t = 0; t < 300; t += 30) {
    bench.add(1, t - 4);
    bench.add(0, t);
  }
  EXPECT_GE(bench.sets.size(), 9u);
  for (const auto& set : bench.sets) EXPECT_EQ(set[1], set[0] - 4);
}

TEST(FrameSync, WhatIsFarOffIsNoPartner) {
  Bench bench(2);
  bench.add(0, 0);
  bench.add(1, 25);
  bench.add(0, 30);
  bench.add(1, 58);
  EXPECT_EQ(bench.sets, (Sets{{30, 25}}));
  EXPECT_EQ(bench.sync.dropped(), 1);
}

TEST(FrameSync, DroppedItemsDropTheirSetOnly) {
  Bench bench(3);
  for (Stamp t = 0; t < 10; ++t) {
    if (t != 3) bench.add(0, 33 * t);
    if (t != 5) bench.add(1, 33 * t + 2);
    if (t != 7) bench.add(2, 33 * t - 3);
  }
  std::vector<Stamp> stamps;
  for (const auto& set : bench.sets) stamps.push_back(set[0] / 33);
  EXPECT_EQ(stamps, (std::vector<Stamp>{0, 1, 2, 4, 6, 8, 9}));
}

TEST(FrameSync, ASlowStreamThatComesLateSetsThePace) {
  Bench bench(3);  // labels: each fifth image, 200 ms late
  for (Stamp t = 0; t < 60; ++t) {
    bench.add(0, 33 * t);
    bench.add(1, 33 * t);
    if (t >= 6 && (t - 6) % 5 == 0) bench.add(2, 33 * (t - 6));
  }
  ASSERT_GE(bench.sets.size(), 10u);
  for (std::size_t i = 0; i < bench.sets.size(); ++i) {
    EXPECT_EQ(bench.sets[i], std::vector<Stamp>(3, static_cast<Stamp>(i) * 5 * 33));
  }
}

TEST(FrameSync, ItemsOutOfOrderFindTheirPlace) {
  Bench bench(2);
  bench.add(0, 33);
  bench.add(0, 0);
  bench.add(1, 34);
  bench.add(1, 1);
  bench.add(1, 67);
  EXPECT_EQ(bench.sets, (Sets{{33, 34}}));  // 34 had come when 0 was looked at: it was given up
  Bench slow(2);
  slow.add(1, 34);
  slow.add(1, 1);
  slow.add(0, 33);
  slow.add(0, 0);
  EXPECT_EQ(slow.sets.size(), 1u);
}

TEST(FrameSync, RandomJitterDropsAndDelaysNeverMixUpSets) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed, 7);
    struct Arrival {
      Stamp at, stamp;
      std::size_t stream;
    };
    std::vector<Arrival> arrivals;
    int whole = 0;
    for (Stamp t = 0; t < 100; ++t) {
      bool all = true;
      for (std::size_t s = 0; s < 3; ++s) {
        if (rng.uniform(0.0, 1.0) < 0.1) {
          all = false;
          continue;
        }
        const auto jitter = static_cast<Stamp>(rng.uniform(-6.0, 6.0));
        const auto delay = static_cast<Stamp>(rng.uniform(0.0, 60.0));
        arrivals.push_back({33 * t + delay, 33 * t + jitter, s});
      }
      whole += all;
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const Arrival& a, const Arrival& b) { return a.at < b.at; });
    Bench bench(3);
    for (const Arrival& arrival : arrivals) bench.add(arrival.stream, arrival.stamp);
    Stamp last = -1000;
    for (const auto& set : bench.sets) {
      const auto turn = [](Stamp t) { return (t + 16) / 33; };
      EXPECT_EQ(turn(set[0]), turn(set[1])) << seed;
      EXPECT_EQ(turn(set[0]), turn(set[2])) << seed;
      EXPECT_GT(set[0], last) << seed;
      last = set[0];
    }
    EXPECT_GE(static_cast<int>(bench.sets.size()), whole / 2) << seed;
  }
}

TEST(FrameSync, QueuesAreBounded) {
  FrameSyncOptions options;
  options.max_items = 5;
  options.max_octets = 1000;
  FrameSync<int> sync(2, options);
  for (int i = 0; i < 100; ++i) sync.add(0, kStart + i * 33 * kMs, i, 10);
  EXPECT_EQ(sync.waiting(0), 5u);
  for (int i = 100; i < 104; ++i) sync.add(0, kStart + i * 33 * kMs, i, 600);
  EXPECT_EQ(sync.waiting(0), 1u);
}

TEST(FrameSync, AClockThatWasSetBackBeginsAnew) {
  Bench bench(2);
  for (Stamp t : {0, 33, 66}) {
    bench.add(0, t);
    bench.add(1, t);
  }
  for (Stamp t : {-60'000, -59'967}) {
    bench.add(0, t);
    bench.add(1, t);
  }
  EXPECT_EQ(bench.sets.size(), 5u);
}

TEST(ClockDifference, TheLeastAgeCounts) {
  ClockDifference clock;
  EXPECT_FALSE(clock.least_age_s());
  for (const Stamp age : {40, 12, 90}) clock.add(age * kMs);
  EXPECT_DOUBLE_EQ(*clock.least_age_s(), 0.012);
  for (int i = 0; i < 300; ++i) clock.add(-500 * kMs);
  EXPECT_DOUBLE_EQ(*clock.least_age_s(), -0.5);
}

}  // namespace
}  // namespace canopeer::ros
