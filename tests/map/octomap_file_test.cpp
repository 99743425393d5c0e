#include "canopeer/map/octomap_file.h"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <filesystem>
#include <memory>

#include "ball_scene.h"
#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

// OctoMap's reading of the file, expanded to voxels.
std::unique_ptr<octomap::OcTree> read_with_octomap(const std::filesystem::path& path) {
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(path.string()));
  return std::unique_ptr<octomap::OcTree>(dynamic_cast<octomap::OcTree*>(any.release()));
}

VoxelIndex index_of(const octomap::OcTreeKey& key) {
  return {key[0] - 32768, key[1] - 32768, key[2] - 32768};
}

TEST(OctomapFile, OctoMapReadsTheOccupancyBack) {
  const VoxelMap map = BallScene::map(1, 3);
  const auto path = temporary("canopeer_map.ot");
  ASSERT_TRUE(write_ot(map, path).has_value());
  const auto tree = read_with_octomap(path);
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(tree->getResolution(), 0.02);
  const std::size_t nodes = tree->size();
  tree->prune();  // nothing left to prune, inner nodes as OctoMap makes them
  EXPECT_EQ(tree->size(), nodes);
  const float root = tree->getRoot()->getLogOdds();
  tree->updateInnerOccupancy();
  EXPECT_EQ(tree->getRoot()->getLogOdds(), root);
  tree->expand();
  std::int64_t voxels = 0;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
    const VoxelIndex v = index_of(leaf.getKey());
    ++voxels;
    ASSERT_EQ(static_cast<double>(leaf->getLogOdds()), map.occupancy_log_odds(v));
    ASSERT_EQ(tree->isNodeOccupied(*leaf), map.occupancy(v) == Occupancy::occupied);
  }
  EXPECT_EQ(voxels, map.observed_voxels());
}

TEST(OctomapFile, TheRoiTreeHoldsTheRoiVoxels) {
  const VoxelMap map = BallScene::map(1, 3);
  const auto path = temporary("canopeer_roi.ot");
  ASSERT_TRUE(write_roi_ot(map, path).has_value());
  const auto tree = read_with_octomap(path);
  ASSERT_NE(tree, nullptr);
  tree->expand();
  std::int64_t roi = 0;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
    const VoxelIndex v = index_of(leaf.getKey());
    ASSERT_EQ(tree->isNodeOccupied(*leaf), map.is_roi(v));
    roi += map.is_roi(v);
  }
  EXPECT_GT(roi, 0);
  EXPECT_EQ(roi, map.roi_voxels());
}

TEST(OctomapFile, ReadsItsOwnFileBackUnchanged) {
  const VoxelMap map = BallScene::map(2, 2);
  const auto path = temporary("canopeer_again.ot");
  ASSERT_TRUE(write_ot(map, path).has_value());
  const auto again = read_ot(path);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again->resolution_m(), 0.02);
  EXPECT_EQ(again->observed_voxels(), map.observed_voxels());
  EXPECT_EQ(again->occupied_voxels(), map.occupied_voxels());
  for (const BlockKey key : map.block_keys()) {
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      ASSERT_EQ(again->occupancy_log_odds(v), map.occupancy_log_odds(v));
    });
  }
  const auto bytes = read_file(path);
  const auto cut = temporary("canopeer_cut.ot");
  ASSERT_TRUE(write_file(cut, bytes->substr(0, bytes->size() / 2)).has_value());
  EXPECT_FALSE(read_ot(cut).has_value());
  const auto empty = temporary("canopeer_empty.ot");
  ASSERT_TRUE(write_ot(VoxelMap(), empty).has_value());
  EXPECT_EQ(read_ot(empty)->observed_voxels(), 0);
}

TEST(OctomapFile, SaysWhichFileIsMissingOrNoTree) {
  const auto missing = read_ot("/nowhere/map.ot");
  ASSERT_FALSE(missing.has_value());
  EXPECT_NE(missing.error().message.find("/nowhere/map.ot"), std::string::npos);
  const auto path = temporary("canopeer_text.ot");
  ASSERT_TRUE(write_file(path, "hello\n").has_value());
  EXPECT_FALSE(read_ot(path).has_value());
  EXPECT_FALSE(write_ot(map_of({{40000, 0, 0}}, {}), temporary("far.ot")).has_value());
}

}  // namespace
}  // namespace canopeer
