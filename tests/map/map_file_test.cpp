#include "canopeer/map/map_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ball_scene.h"
#include "canopeer/base/atomic_file.h"
#include "same_map.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

class MapFiles : public testing::Test {
 protected:
  void SetUp() override {
    directory_ =
        fs::path(testing::TempDir()) /
        (std::string("canopeer_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }
  fs::path directory_;
};

TEST_F(MapFiles, FormatsThatKeepLogOddsGiveTheSameMapBack) {
  const VoxelMap map = BallScene::map(1, 2);
  for (const char* name : {"map.cmap", "map.ot"}) {
    const auto written = write_map(map, directory_ / name);
    ASSERT_TRUE(written.has_value()) << written.error().message;
    const auto read = read_map(directory_ / name);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->files, *written);
    expect_same_map(map, read->map);
  }
  EXPECT_TRUE(fs::exists(directory_ / "map_roi.ot"));
  EXPECT_FALSE(fs::exists(directory_ / "map_roi.cmap"));
}

TEST_F(MapFiles, BinaryTreesKeepWhatIsFreeOccupiedAndRoi) {
  const VoxelMap map = BallScene::map(1, 2);
  ASSERT_TRUE(write_map(map, directory_ / "map.bt").has_value());
  const auto read = read_map(directory_ / "map.bt");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->map.block_keys(), map.block_keys());
  for (const BlockKey key : map.block_keys()) {
    EXPECT_TRUE(read->map.block(key)->observed == map.block(key)->observed);
    EXPECT_TRUE(read->map.block(key)->occupied == map.block(key)->occupied);
    EXPECT_TRUE(read->map.block(key)->roi == map.block(key)->roi);
  }
}

TEST_F(MapFiles, PlyHoldsAPointPerVoxelAndTheRoiBeside) {
  const VoxelMap map = BallScene::map(1, 2);
  ASSERT_TRUE(write_map(map, directory_ / "map.ply").has_value());
  const auto count = [](std::int64_t n) { return "element vertex " + std::to_string(n) + "\n"; };
  EXPECT_NE(read_file(directory_ / "map.ply")->find(count(map.occupied_voxels())),
            std::string::npos);
  EXPECT_NE(read_file(directory_ / "map_roi.ply")->find(count(map.roi_voxels())),
            std::string::npos);
}

TEST_F(MapFiles, AMapWithoutRoiHasNoRoiFileButReplacesAnOldOne) {
  const VoxelMap plain = map_of({{0, 0, 0}}, {{1, 0, 0}});
  ASSERT_TRUE(write_map(plain, directory_ / "a.ot").has_value());
  EXPECT_FALSE(fs::exists(directory_ / "a_roi.ot"));
  ASSERT_TRUE(write_map(map_of({}, {{1, 0, 0}}, {{1, 0, 0}}), directory_ / "b.ot").has_value());
  EXPECT_EQ(read_map(directory_ / "b.ot")->map.roi_voxels(), 1);
  ASSERT_TRUE(write_map(plain, directory_ / "b.ot").has_value());
  EXPECT_EQ(read_map(directory_ / "b.ot")->map.roi_voxels(), 0);
}

TEST_F(MapFiles, WhatCannotBeIsSaidBeforehand) {
  EXPECT_TRUE(check_map_destination(directory_ / "map.ot").has_value());
  EXPECT_TRUE(check_map_destination("map.cmap").has_value());
  EXPECT_NE(check_map_destination(directory_ / "map.obj").error().message.find(".cmap"),
            std::string::npos);
  EXPECT_NE(check_map_destination(directory_ / "none" / "map.ot").error().message.find("none"),
            std::string::npos);
  EXPECT_FALSE(check_map_destination(directory_ / "map").has_value());
  std::ofstream(directory_ / "cloud.ply") << "ply\n";
  EXPECT_NE(read_map(directory_ / "cloud.ply").error().message.find("cloud.ply"),
            std::string::npos);
  EXPECT_FALSE(read_map(directory_).has_value());
}

}  // namespace
}  // namespace canopeer
