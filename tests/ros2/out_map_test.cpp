#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "ball_scene.h"
#include "canopeer/ros2/out/message_parts.h"
#include "canopeer/ros2/out/octomap_message.h"
#include "canopeer/ros2/out/voxel_cloud.h"
#include "octomap_oracle.h"

namespace canopeer::ros {
namespace {

const std_msgs::Header kInMap = header_of("map", 1'500'000'000);

std::vector<std::array<float, 4>> points_of(const sensor_msgs::PointCloud2& cloud) {
  std::vector<std::array<float, 4>> points(cloud.width);
  EXPECT_EQ(cloud.data.size(), sizeof(points[0]) * points.size());
  std::memcpy(points.data(), cloud.data.data(), cloud.data.size());
  return points;
}

/// As octomap_msgs/conversions.h does it: a tree of the resolution, then the nodes.
octomap::OcTree tree_of(const octomap_msgs::Octomap& message) {
  octomap::OcTree tree(message.resolution);
  std::stringstream bytes(std::string(message.data.begin(), message.data.end()));
  if (message.data.empty()) return tree;
  message.binary ? tree.readBinaryData(bytes) : tree.readData(bytes);
  EXPECT_TRUE(bytes.good());
  EXPECT_EQ(bytes.peek(), std::stringstream::traits_type::eof());
  return tree;
}

TEST(VoxelCloud, HasCentresAndProbabilities) {
  VoxelMap map = map_of({{0, 0, 0}}, {{1, 2, 3}, {-20, 0, 5}}, {{1, 2, 3}});
  const auto cloud = occupied_cloud(map, kInMap);
  EXPECT_EQ(cloud.header.frame_id, "map");
  EXPECT_EQ(cloud.header.stamp.nanosec, 500'000'000u);
  EXPECT_EQ(cloud.height, 1u);
  ASSERT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.fields[3].name, "intensity");
  const auto points = points_of(cloud);
  ASSERT_EQ(points.size(), 2u);
  const auto& point = points[0][0] > 0.0F ? points[0] : points[1];
  EXPECT_FLOAT_EQ(point[0], 0.015F);
  EXPECT_FLOAT_EQ(point[1], 0.025F);
  EXPECT_FLOAT_EQ(point[2], 0.035F);
  EXPECT_NEAR(point[3], 1.0 / (1.0 + std::exp(-1.0)), 1e-3);  // log-odds are rounded to 1/2048

  const auto roi = points_of(roi_cloud(map, kInMap));
  ASSERT_EQ(roi.size(), 1u);
  EXPECT_FLOAT_EQ(roi[0][2], 0.035F);
}

TEST(VoxelCloud, OfNothingIsEmptyAndValid) {
  const auto cloud = occupied_cloud(VoxelMap(), kInMap);
  EXPECT_EQ(cloud.width, 0u);
  EXPECT_TRUE(cloud.data.empty());
  EXPECT_EQ(cloud.point_step, 16u);
}

TEST(OctomapMessage, IsReadByOctoMapVoxelByVoxel) {
  const VoxelMap map = BallScene::map(3, 2);
  const auto full = octomap_message(map, false, kInMap);
  ASSERT_TRUE(full) << full.error().message;
  EXPECT_EQ(full->id, "OcTree");
  EXPECT_FALSE(full->binary);
  octomap::OcTree tree = tree_of(*full);
  const Comparison found = compare(map, tree);
  EXPECT_EQ(found.compared, map.observed_voxels());
  EXPECT_EQ(found.different, 0);
}

TEST(OctomapMessage, InBinaryHasFreeAndOccupied) {
  const VoxelMap map = BallScene::map(4, 2);
  const auto binary = octomap_message(map, true, kInMap);
  ASSERT_TRUE(binary) << binary.error().message;
  EXPECT_TRUE(binary->binary);
  octomap::OcTree tree = tree_of(*binary);
  tree.expand();
  std::int64_t compared = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf, ++compared) {
    const bool occupied = map.occupancy(index_of(leaf.getKey())) == Occupancy::occupied;
    ASSERT_EQ(tree.isNodeOccupied(*leaf), occupied);
  }
  EXPECT_EQ(compared, map.observed_voxels());
  EXPECT_LT(binary->data.size() * 4, octomap_message(map, false, kInMap)->data.size());
}

TEST(OctomapMessage, OfNothingIsEmpty) {
  const auto empty = octomap_message(VoxelMap(), true, kInMap);
  ASSERT_TRUE(empty);
  EXPECT_TRUE(empty->data.empty());
  EXPECT_EQ(tree_of(*empty).size(), 0u);
}

}  // namespace
}  // namespace canopeer::ros
