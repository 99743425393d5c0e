#pragma once

#include <gtest/gtest.h>

#include "canopeer/map/voxel_map.h"

namespace canopeer {

/// Fails the test unless both maps hold the same blocks, log-odds and masks, to the bit.
inline void expect_same_map(const VoxelMap& a, const VoxelMap& b) {
  EXPECT_EQ(a.observed_voxels(), b.observed_voxels());
  EXPECT_EQ(a.occupied_voxels(), b.occupied_voxels());
  EXPECT_EQ(a.roi_voxels(), b.roi_voxels());
  EXPECT_EQ(a.resolution_m(), b.resolution_m());
  ASSERT_EQ(a.block_keys(), b.block_keys());
  for (const BlockKey key : a.block_keys()) {
    EXPECT_TRUE(a.block(key)->observed == b.block(key)->observed);
    EXPECT_TRUE(a.block(key)->occupied == b.block(key)->occupied);
    EXPECT_TRUE(a.block(key)->roi == b.block(key)->roi);
    for_each_voxel(key, VoxelMask::all(), [&](const VoxelIndex& v) {
      ASSERT_EQ(a.occupancy_log_odds(v), b.occupancy_log_odds(v));
      ASSERT_EQ(a.roi_log_odds(v), b.roi_log_odds(v));
    });
  }
}

}  // namespace canopeer
