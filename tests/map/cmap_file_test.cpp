#include "canopeer/map/cmap_file.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <limits>

#include "ball_scene.h"
#include "canopeer/base/atomic_file.h"
#include "same_map.h"

namespace canopeer {
namespace {

// Tests run side by side: each has files of its own.
std::filesystem::path temporary(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  return std::filesystem::path(testing::TempDir()) / (test + "_" + name);
}

void expect_round_trip(const VoxelMap& map) {
  const auto path = temporary("canopeer_round_trip.cmap");
  const auto written = write_cmap(map, path);
  ASSERT_TRUE(written.has_value()) << written.error().message;
  const auto again = read_cmap(path);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  expect_same_map(map, *again);
  const VoxelMapOptions& a = map.options();
  const VoxelMapOptions& b = again->options();
  EXPECT_EQ(a.hit_probability, b.hit_probability);
  EXPECT_EQ(a.miss_probability, b.miss_probability);
  EXPECT_EQ(a.clamp_min, b.clamp_min);
  EXPECT_EQ(a.clamp_max, b.clamp_max);
  EXPECT_EQ(a.occupied_threshold, b.occupied_threshold);
  EXPECT_EQ(cmap_bytes(map), cmap_bytes(*again));
}

TEST(CmapFile, RoundTripIsIdentity) {
  expect_round_trip(VoxelMap());
  expect_round_trip(BallScene::map(1, 1));
  expect_round_trip(BallScene::map(2, 2, 0.01));  // several groups of blocks
}

TEST(CmapFile, KeepsEveryOptionAndMapsAtTheEndsOfTheIndexRange) {
  VoxelMapOptions options;
  options.resolution_m = 0.1 / 3.0;
  options.hit_probability = 0.6;  // ROI log-odds that come back to 0 are still ROI
  options.miss_probability = 0.4;
  options.clamp_min = 0.0005;
  options.clamp_max = 0.9995;
  options.occupied_threshold = 0.4;
  VoxelMap map(options);
  const int end = kBlockSide * kBlockIndexLimit;
  map.set_occupancy_log_odds({-end, -end, -end}, -7.5);
  map.set_occupancy_log_odds({end - 1, end - 1, end - 1}, 7.5);
  map.set_occupancy_log_odds({0, 0, 0}, 0.0);
  map.set_roi_log_odds({-1, -1, -1}, 0.0);
  map.set_roi_log_odds({-9, 5, 5}, -1.0);  // ROI log-odds where nothing is observed
  ASSERT_EQ(map.roi_voxels(), 1);
  expect_round_trip(map);
}

TEST(CmapFile, AMapThatIsReadBackGoesOnAsTheOldOneWould) {
  VoxelMap map = BallScene::map(3, 2);
  auto again = parse_cmap(cmap_bytes(map));
  ASSERT_TRUE(again.has_value());
  const BallScene scene = BallScene::random(3, 60);
  Rng rng(9, "later");
  const auto view =
      scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(160, 120, 1.396));
  fuse(map, view.frame, view.roi);
  fuse(*again, view.frame, view.roi);
  expect_same_map(map, *again);
}

TEST(CmapFile, AnyNumberOfThreadsWritesTheSameBytes) {
  const VoxelMap map = BallScene::map(2, 1, 0.01);
  const auto bytes = [&](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return cmap_bytes(map);
  };
  EXPECT_TRUE(bytes(1) == bytes(4));
}

TEST(CmapFile, ErrorsSayWhatIsWrong) {
  const std::string bytes = cmap_bytes(BallScene::map(2, 2));
  const auto message = [](const std::string& damaged) {
    const auto map = parse_cmap(damaged);
    return map.has_value() ? std::string("no error") : map.error().message;
  };
  const auto expect_in = [](const std::string& part, const std::string& whole) {
    EXPECT_NE(whole.find(part), std::string::npos) << whole;
  };
  expect_in("not a canopeer map", message("hello"));
  expect_in("not a canopeer map", message(""));
  expect_in("cut off", message(bytes.substr(0, 10)));
  expect_in("cut off", message(bytes.substr(0, 60)));
  expect_in("cut off", message(bytes.substr(0, bytes.size() / 2)));
  expect_in("cut off", message(bytes.substr(0, 112)));  // all groups missing
  std::string other = bytes;
  other[8] = 9;
  expect_in("format version 9", message(other));
  other = bytes;
  other[20] ^= 1;
  expect_in("checksum of the header", message(other));
  other = bytes;
  other[bytes.size() - 100] ^= 1;
  expect_in("checksum of a group", message(other));
  expect_in("cut off", message(bytes + "more"));
  const auto missing = read_cmap("/nowhere/map.cmap");
  ASSERT_FALSE(missing.has_value());
  expect_in("/nowhere/map.cmap", missing.error().message);
}

}  // namespace
}  // namespace canopeer
