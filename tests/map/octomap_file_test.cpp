#include "canopeer/map/octomap_file.h"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "ball_scene.h"
#include "canopeer/base/atomic_file.h"
#include "octomap_oracle.h"
#include "same_map.h"

namespace canopeer {
namespace {

// Tests run side by side: each has files of its own.
std::filesystem::path temporary(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  return std::filesystem::path(testing::TempDir()) / (test + "_" + name);
}

// OctoMap's reading of the file, expanded to voxels.
std::unique_ptr<octomap::OcTree> read_with_octomap(const std::filesystem::path& path) {
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(path.string()));
  return std::unique_ptr<octomap::OcTree>(dynamic_cast<octomap::OcTree*>(any.release()));
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
  const auto again = read_octomap(path);
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
  EXPECT_FALSE(read_octomap(cut).has_value());
  const auto empty = temporary("canopeer_empty.ot");
  ASSERT_TRUE(write_ot(VoxelMap(), empty).has_value());
  EXPECT_EQ(read_octomap(empty)->observed_voxels(), 0);
}

// A tree as a user of OctoMap has one: clamped and pruned by itself, with its own colours if any.
template <typename Tree>
Tree octomap_tree(std::uint64_t seed) {
  Rng rng(seed, "octomap");
  Tree tree(0.1);
  octomap::Pointcloud cloud;
  for (int i = 0; i < 800; ++i) {
    cloud.push_back(static_cast<float>(rng.uniform(-2, 2)), static_cast<float>(rng.uniform(-2, 2)),
                    static_cast<float>(rng.uniform(-2, 2)));
  }
  for (int i = 0; i < 12; ++i) tree.insertPointCloud(cloud, octomap::point3d(0, 0, 0), 1.5);
  for (int x = -8; x < 8; ++x) {  // eight voxels a side: pruned over two levels
    for (int y = -8; y < 0; ++y) {
      for (int z = 0; z < 8; ++z) {
        tree.setNodeValue(octomap::point3d(static_cast<float>(0.1 * x + 20.05),
                                           static_cast<float>(0.1 * y + 20.05),
                                           static_cast<float>(0.1 * z + 20.05)),
                          tree.getClampingThresMinLog());
      }
    }
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

template <typename Tree>
void expect_same_voxels(Tree& tree, const VoxelMap& map, bool binary) {
  tree.expand();
  std::int64_t voxels = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const VoxelIndex v = index_of(leaf.getKey());
    ++voxels;
    ASSERT_EQ(tree.isNodeOccupied(*leaf), map.occupancy(v) == Occupancy::occupied);
    if (binary) continue;
    const VoxelMapOptions& o = map.options();  // narrower clamps than OctoMap's by a few 1e-3
    const double expected = std::clamp(static_cast<double>(leaf->getLogOdds()),
                                       std::log(o.clamp_min / (1 - o.clamp_min)),
                                       std::log(o.clamp_max / (1 - o.clamp_max)));
    ASSERT_NEAR(map.occupancy_log_odds(v), expected, 2.5e-4);
  }
  EXPECT_GT(voxels, 3000);
  EXPECT_EQ(voxels, map.observed_voxels());
}

TEST(OctomapFile, ReadsWhatOctoMapWrites) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    auto tree = octomap_tree<octomap::OcTree>(seed);
    const auto full = temporary("canopeer_theirs.ot");
    const auto binary = temporary("canopeer_theirs.bt");
    ASSERT_TRUE(tree.write(full.string()));
    ASSERT_TRUE(tree.writeBinaryConst(binary.string()));
    const auto from_full = read_octomap(full);
    ASSERT_TRUE(from_full.has_value()) << from_full.error().message;
    const auto from_binary = read_octomap(binary);
    ASSERT_TRUE(from_binary.has_value()) << from_binary.error().message;
    EXPECT_EQ(from_full->resolution_m(), 0.1);
    expect_same_voxels(tree, *from_full, false);
    expect_same_voxels(tree, *from_binary, true);
  }
}

TEST(OctomapFile, ReadsTreesWithColours) {
  auto tree = octomap_tree<octomap::ColorOcTree>(4);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) leaf->setColor(1, 2, 3);
  const auto path = temporary("canopeer_colours.ot");
  ASSERT_TRUE(tree.write(path.string()));
  const auto map = read_octomap(path);
  ASSERT_TRUE(map.has_value()) << map.error().message;
  expect_same_voxels(tree, *map, false);
}

TEST(OctomapFile, OctoMapReadsTheBinaryFilesBack) {
  const VoxelMap map = BallScene::map(1, 3);
  const auto path = temporary("canopeer_map.bt");
  ASSERT_TRUE(write_bt(map, path).has_value());
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(path.string()));  // compares the number of nodes too
  EXPECT_EQ(tree.getResolution(), 0.02);
  const std::size_t nodes = tree.size();
  tree.prune();
  EXPECT_EQ(tree.size(), nodes) << "nothing left to prune";
  expect_same_voxels(tree, map, true);

  const auto roi_path = temporary("canopeer_map_roi.bt");
  ASSERT_TRUE(write_roi_bt(map, roi_path).has_value());
  octomap::OcTree roi_tree(1.0);
  ASSERT_TRUE(roi_tree.readBinary(roi_path.string()));
  roi_tree.expand();
  std::int64_t roi = 0;
  for (auto leaf = roi_tree.begin_leafs(); leaf != roi_tree.end_leafs(); ++leaf) {
    ASSERT_EQ(roi_tree.isNodeOccupied(*leaf), map.is_roi(index_of(leaf.getKey())));
    roi += roi_tree.isNodeOccupied(*leaf);
  }
  EXPECT_EQ(roi, map.roi_voxels());
}

TEST(OctomapFile, TheRoiTreeIsReadBack) {
  const VoxelMap map = BallScene::map(1, 3);
  const auto path = temporary("canopeer_pair.ot");
  const auto roi_path = temporary("canopeer_pair_roi.ot");
  ASSERT_TRUE(write_ot(map, path).has_value());
  ASSERT_TRUE(write_roi_ot(map, roi_path).has_value());
  auto again = read_octomap(path);
  ASSERT_TRUE(again.has_value());
  ASSERT_TRUE(read_octomap_roi(roi_path, *again).has_value());
  expect_same_map(map, *again);
  VoxelMap finer;
  const auto other = read_octomap_roi(roi_path, finer);
  ASSERT_FALSE(other.has_value());
  EXPECT_NE(other.error().message.find("resolution"), std::string::npos);
}

// Hits and misses of the same size: log-odds of ROI voxels come back to 0, which is not "never
// touched".
TEST(OctomapFile, RoiLogOddsOfZeroAreKept) {
  VoxelMapOptions options;
  options.hit_probability = 0.6;
  VoxelMap map(options);
  map.set_occupancy_log_odds({1, 2, 3}, 1.0);
  map.set_roi_log_odds({1, 2, 3}, 0.0);
  ASSERT_EQ(map.roi_voxels(), 1);
  const auto path = temporary("canopeer_zero_roi.ot");
  ASSERT_TRUE(write_roi_ot(map, path).has_value());
  VoxelMap again;
  ASSERT_TRUE(read_octomap_roi(path, again).has_value());
  EXPECT_EQ(again.roi_voxels(), 1);
}

TEST(OctomapFile, KeepsAResolutionOfManyDigits) {
  VoxelMapOptions options;
  options.resolution_m = 0.1 / 3.0;
  VoxelMap map(options);
  map.set_occupancy_log_odds({0, 0, 0}, 1.0);
  const auto path = temporary("canopeer_third.ot");
  ASSERT_TRUE(write_ot(map, path).has_value());
  EXPECT_EQ(read_octomap(path)->resolution_m(), 0.1 / 3.0);
}

TEST(OctomapFile, AFewBytesCannotMakeAHugeMap) {
  const std::string header = "# Octomap OcTree file\nid OcTree\nsize 1\nres 0.01\ndata\n";
  const auto map = parse_octomap(header + std::string("\0\0\x80\x3f\0", 5));  // one leaf: all space
  ASSERT_FALSE(map.has_value());
  EXPECT_NE(map.error().message.find("voxels"), std::string::npos);
}

TEST(OctomapFile, SaysWhichFileIsMissingOrNoTree) {
  const auto missing = read_octomap("/nowhere/map.ot");
  ASSERT_FALSE(missing.has_value());
  EXPECT_NE(missing.error().message.find("/nowhere/map.ot"), std::string::npos);
  const auto path = temporary("canopeer_text.ot");
  ASSERT_TRUE(write_file(path, "hello\n").has_value());
  EXPECT_FALSE(read_octomap(path).has_value());
  EXPECT_FALSE(write_ot(map_of({{40000, 0, 0}}, {}), temporary("far.ot")).has_value());
}

}  // namespace
}  // namespace canopeer
