#include <gtest/gtest.h>

#include <cmath>

#include "../detect/synthetic_view.h"
#include "canopeer/base/rng.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

using namespace synthetic;

constexpr int kFrames = 7;

/// Fruits of a row from cameras that go along it: one is taken for none for a while, two touch,
/// one is partly behind a leaf.
const std::vector<View>& views() {
  static const std::vector<View> kViews = [] {
    const Vec3 doubtful(0.6, -0.2, 0.6);
    std::vector<Body> bodies;
    for (const Vec3& centre :
         {doubtful, Vec3(0.6, -0.05, 0.62), Vec3(0.61, 0.015, 0.6), Vec3(0.6, 0.15, 0.58)}) {
      bodies.push_back(superellipsoid(centre, {0.033, 0.031, 0.038}, 0.7, kRipe, true));
    }
    bodies.push_back(block(Box(Vec3(0.5, 0.13, 0.5), Vec3(0.502, 0.15, 0.7)), kLeaf));
    Rng rng(3);
    std::vector<View> made;
    for (int i = 0; i < kFrames; ++i) {
      const Vec3 from(0.05, 0.05 * i - 0.2, 0.7 + 0.02 * (i % 2));
      View& view = made.emplace_back(look(bodies, from, from + Vec3(0.55, 0.04, -0.1)));
      RgbdFrame& frame = view.frame;
      frame.time_s = 2.0 * i;
      for (int v = 0; v < view.fruit.height(); ++v) {
        for (int u = 0; u < view.fruit.width(); ++u) {
          std::uint8_t& label = view.fruit.at(u, v);
          if (label == 0) continue;
          const Vec3 p =
              frame.T_world_camera * (double{frame.depth.at(u, v)} * frame.intrinsics.ray(u, v));
          const bool none = (i == 1 || i == 2) && (p - doubtful).norm() < 0.08;
          // As detectors do: of other classes than the last time, and with holes.
          label = none || rng.chance(0.1) ? 0 : rng.chance(0.3) ? 2 : 3;
        }
      }
    }
    return made;
  }();
  return kViews;
}

FruitMapOptions ordinary() {
  FruitMapOptions options;
  options.rows = {{"A", {0.6, -1.0, 0.0}, Vec3::UnitY()}};
  return options;
}

/// Most of what changes has to wait.
FruitMapOptions hurried() {
  FruitMapOptions options = ordinary();
  options.update_points = 1;
  options.update_blocks = 2;
  return options;
}

/// All that can be asked of a map.
std::string answers(const FruitMap& map) {
  std::vector<FruitEvidence> evidence;
  for (std::size_t i = 0; i < map.candidates().size(); ++i) evidence.push_back(map.evidence(i));
  const SurfaceMesh mesh = map.surface();
  const PointCloud cloud = map.cloud();
  return state_bytes(map.fruits(), map.candidates(), evidence, map.id_changes(), map.waiting(),
                     map.fits(), mesh.vertices, mesh.fruit, mesh.triangles, cloud.points,
                     cloud.normals, cloud.colors, map.state());
}

/// A mission: a step adds the next frame or updates; after the last frame comes update_all().
constexpr int kSteps = 2 * kFrames + 1;
void take_step(FruitMap& map, int step) {
  if (step == kSteps - 1) return map.update_all();
  if (step % 2 == 1) return map.update();
  const View& view = views()[static_cast<std::size_t>(step / 2)];
  map.add(view.frame, view.fruit);
}

FruitMap after_steps(int steps, const FruitMapOptions& options) {
  FruitMap map(options);
  for (int step = 0; step < steps; ++step) take_step(map, step);
  return map;
}

/// Cuts the mission at each step: whatever goes on from there, it gives the same at every step.
void expect_the_same_from_any_cut(const FruitMapOptions& options, bool by_copy) {
  std::vector<std::string> uncut;  // after each step
  FruitMap whole(options);
  std::vector<FruitMap> going_on;
  for (int step = 0; step < kSteps; ++step) {
    if (by_copy) {
      going_on.push_back(whole);
    } else {
      ASSERT_TRUE(going_on.emplace_back(options).restore(whole.state()).has_value());
    }
    EXPECT_TRUE(answers(going_on.back()) == answers(whole)) << "cut before step " << step;
    take_step(whole, step);
    uncut.push_back(answers(whole));
  }
  EXPECT_GE(whole.fruits().size(), 3U);
  for (int cut = 0; cut < kSteps; ++cut) {
    FruitMap& map = going_on[static_cast<std::size_t>(cut)];
    for (int step = cut; step < kSteps; ++step) {
      take_step(map, step);
      ASSERT_TRUE(answers(map) == uncut[static_cast<std::size_t>(step)])
          << "cut before step " << cut << ", another after step " << step;
    }
  }
}

TEST(FruitMapState, ACopyGoesOnAsTheOriginalDoes) {
  expect_the_same_from_any_cut(ordinary(), true);
}

TEST(FruitMapState, ARestoredMapGoesOnAsTheOneNeverCut) {
  expect_the_same_from_any_cut(ordinary(), false);
}

TEST(FruitMapState, WhatWaitsGoesOnWaiting) {
  const FruitMap map = after_steps(kSteps - 1, hurried());
  ASSERT_GT(map.waiting(), 0);
  expect_the_same_from_any_cut(hurried(), true);
  expect_the_same_from_any_cut(hurried(), false);
}

TEST(FruitMapState, ACopyAndItsOriginalKnowNothingOfEachOther) {
  FruitMap map = after_steps(4, ordinary());
  const std::string before = answers(map);
  FruitMap copy = map;
  for (int step = 4; step < kSteps; ++step) take_step(copy, step);
  EXPECT_TRUE(answers(map) == before);
  const std::string after = answers(copy);
  map.update_all();
  EXPECT_TRUE(answers(copy) == after);
  copy = map;
  EXPECT_TRUE(answers(copy) == answers(map));
}

TEST(FruitMapState, OfATrackerHoldsTheLostOnesAndWhatHappenedLast) {
  const TrackedFruit one{-1, Vec3(0, 0, 0), {1, 2, 3, 4, 5, 6, 7}};
  const TrackedFruit half{-1, Vec3(0.02, 0, 0), {5, 6, 7}};
  const TrackedFruit rest{-1, Vec3(0, 0, 0), {1, 2, 3, 4}};
  FruitTracker tracker(0.05);
  std::vector<TrackedFruit> first = {one};
  tracker.assign(first, {});
  std::vector<TrackedFruit> then = {half, rest};
  tracker.assign(then, first);
  FruitTracker after_split(0.05);
  ASSERT_TRUE(read_state_bytes(state_bytes(tracker), after_split).has_value());
  ASSERT_EQ(after_split.changes().size(), 1U);
  EXPECT_TRUE(state_bytes(after_split.changes()) == state_bytes(tracker.changes()));
  std::vector<TrackedFruit> none;
  tracker.assign(none, then);
  FruitTracker after_loss(0.05);
  ASSERT_TRUE(read_state_bytes(state_bytes(tracker), after_loss).has_value());
  std::vector<TrackedFruit> again = {{-1, Vec3(3, 0, 0), {50}}, half};
  after_loss.assign(again, {});
  EXPECT_EQ(again[0].id, 2);
  EXPECT_EQ(again[1].id, 1);
}

TEST(FruitMapState, IsTakenInPlaceOfWhatTheMapKnew) {
  const FruitMap map = after_steps(6, ordinary());
  FruitMap other = after_steps(2, ordinary());
  ASSERT_TRUE(other.restore(map.state()).has_value());
  EXPECT_TRUE(answers(other) == answers(map));
}

TEST(FruitMapState, OfASurfaceOfOtherVoxelsIsRefused) {
  const std::string state = after_steps(4, ordinary()).state();
  FruitMapOptions coarse = ordinary();
  coarse.tsdf.voxel_m = 0.005;
  FruitMapOptions thick = ordinary();
  thick.tsdf.truncation_m = 0.016;
  for (const FruitMapOptions& options : {coarse, thick}) {
    FruitMap map = after_steps(2, options);
    const std::string before = answers(map);
    const auto refused = map.restore(state);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("tsdf"), std::string::npos);
    EXPECT_TRUE(answers(map) == before);
  }
}

TEST(FruitMapState, WithOtherOptionsOfReportingTheseHoldFromThereOn) {
  FruitMapOptions sure = ordinary();
  sure.min_confidence = 1.0;
  FruitMap map(sure);
  ASSERT_TRUE(map.restore(after_steps(4, ordinary()).state()).has_value());
  EXPECT_FALSE(map.candidates().empty());
  EXPECT_TRUE(map.fruits().empty());
}

TEST(FruitMapState, CutShortOrTooLongIsRefusedAndLeavesTheMapAsItWas) {
  const std::string state = after_steps(4, ordinary()).state();
  FruitMap map = after_steps(2, ordinary());
  const std::string before = answers(map);
  Rng rng(1);
  std::vector<std::size_t> sizes;
  for (std::size_t size = 0; size < 200; ++size) sizes.push_back(size);
  for (int i = 0; i < 200; ++i) {
    sizes.push_back(static_cast<std::size_t>(rng.uniform() * static_cast<double>(state.size())));
  }
  for (const std::size_t size : sizes) {
    EXPECT_FALSE(map.restore(std::string_view(state).substr(0, size)).has_value()) << size;
  }
  EXPECT_FALSE(map.restore(state + '\0').has_value());
  EXPECT_TRUE(answers(map) == before);
}

TEST(FruitMapState, TakesAnyBytes) {
  const std::string state = after_steps(4, ordinary()).state();
  FruitMap map = after_steps(2, ordinary());
  const std::string before = map.state();
  Rng rng(2);
  const auto flip = [](std::string& bytes, double where) {
    const auto bit = static_cast<std::size_t>(where * 8.0 * static_cast<double>(bytes.size()));
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
  };
  const auto start = 500.0 / static_cast<double>(state.size());
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::string damaged = state;
    // Everywhere, the beginning, and the end with the fruits.
    const double where = rng.uniform();
    flip(damaged, i % 3 == 0 ? where : i % 3 == 1 ? start * where : 1.0 - 20.0 * start * where);
    if (!map.restore(damaged)) {
      ++refused;
      ASSERT_TRUE(map.state() == before) << i;
      continue;
    }
    // Another number somewhere: what was read can be asked for and written.
    EXPECT_FALSE(answers(map).empty());
    ASSERT_TRUE(map.restore(before).has_value());
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace canopeer
