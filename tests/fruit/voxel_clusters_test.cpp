#include "canopeer/fruit/voxel_clusters.h"

#include <gtest/gtest.h>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

TEST(VoxelClusters, AgreeWithComparingAllPairs) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    std::vector<VoxelIndex> voxels;
    VoxelClusters clusters(2.0);
    for (int i = 0; i < 150; ++i) {
      const auto coordinate = [&] { return static_cast<int>(rng.index(16)) - 8; };
      const VoxelIndex v(coordinate(), coordinate(), coordinate());
      if (clusters.insert(v) == static_cast<int>(voxels.size())) voxels.push_back(v);
    }
    // Labels spread over pairs in reach until nothing changes.
    std::vector<int> label(voxels.size());
    for (std::size_t i = 0; i < label.size(); ++i) label[i] = static_cast<int>(i);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < voxels.size(); ++i) {
        for (std::size_t j = 0; j < voxels.size(); ++j) {
          if ((voxels[i] - voxels[j]).squaredNorm() <= 4 && label[j] < label[i]) {
            label[i] = label[j];
            changed = true;
          }
        }
      }
    }
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      ASSERT_EQ(clusters.root(static_cast<int>(i)), label[i]) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace canopeer
