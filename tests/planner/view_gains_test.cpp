#include "canopeer/planner/nbv/view_gains.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

using Cell = std::tuple<int, int, int>;

Cell cell(const VoxelIndex& v) { return {v.x(), v.y(), v.z()}; }

double probability(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

double entropy(double p) { return -p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p); }

/// Half a metre of space in 2 cm voxels: free, unknown and occupied ones, some of them fruit, and a
/// camera that looks into it.
struct TinyWorld {
  explicit TinyWorld(std::uint64_t seed) : map({.resolution_m = 0.02}) {
    Rng rng(seed);
    for (int x = -15; x <= 15; ++x) {
      for (int y = -15; y <= 15; ++y) {
        for (int z = 0; z < 28; ++z) {
          const VoxelIndex voxel(x, y, z);
          const double draw = rng.uniform();
          if (draw < 0.35) {
            map.set_occupancy_log_odds(voxel, -rng.uniform(0.2, 1.9));
          } else if (draw < 0.38) {
            map.set_occupancy_log_odds(voxel, rng.uniform(0.1, 3.0));
            if (rng.chance(0.2)) map.set_roi_log_odds(voxel, rng.uniform(0.1, 3.0));
          }
        }
      }
    }
    map.for_each_roi(everywhere, [&](const VoxelIndex& v) { fruit_voxels.push_back(v); });
    distance.rebuild(map, everywhere);
    T_world_camera = Pose(Eigen::Translation3d(0.013, -0.021, -0.04));
    T_world_camera.rotate(Eigen::AngleAxisd(0.2, Vec3(0.3, 1.0, 0.5).normalized()));
  }

  [[nodiscard]] GainScene scene() const {
    ViewFan fan;
    fan.columns = 9;
    fan.rows = 7;
    fan.depth_m = 0.5;
    return {map, distance, fan, 0.05};
  }
  /// To the nearest fruit voxel; infinite: there is none.
  [[nodiscard]] double fruit_distance(const VoxelIndex& voxel) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const VoxelIndex& f : fruit_voxels) {
      nearest = std::min(nearest, (f - voxel).cast<double>().norm() * 0.02);
    }
    return nearest;
  }
  /// `visit(voxel)` for the voxels of each ray, until it says no.
  template <typename Begin, typename Visit>
  void walk_rays(Begin&& begin, Visit&& visit) const {
    for (const Vec3& end : ray_ends(scene().fan, T_world_camera)) {
      begin();
      walk_voxels(T_world_camera.translation(), end, 0.02, visit);
    }
  }
  [[nodiscard]] std::map<Cell, VoxelIndex> unknown_before_occupied() const {
    std::map<Cell, VoxelIndex> unknown;
    walk_rays([] {},
              [&](const VoxelIndex& v) {
                if (map.occupancy(v) == Occupancy::unknown) unknown.emplace(cell(v), v);
                return map.occupancy(v) != Occupancy::occupied;
              });
    return unknown;
  }
  [[nodiscard]] std::map<Cell, std::pair<VoxelIndex, double>> visible() const {
    std::map<Cell, std::pair<VoxelIndex, double>> all;
    double v = 1.0;
    walk_rays([&] { v = 1.0; },
              [&](const VoxelIndex& voxel) {
                auto& known = all.emplace(cell(voxel), std::pair(voxel, v)).first->second.second;
                known = std::max(known, v);
                const double p = probability(map.occupancy_log_odds(voxel));
                const bool occupied = map.occupancy(voxel) == Occupancy::occupied;
                v *= occupied ? 1.0 - p : std::pow(1.0 - p, 0.02 / 0.05);
                return v >= 0.01;
              });
    return all;
  }

  VoxelMap map;
  Box everywhere{Vec3::Constant(-2.0), Vec3::Constant(2.0)};
  std::vector<VoxelIndex> fruit_voxels;
  FruitDistance distance;
  Pose T_world_camera;
};

class ViewGains : public ::testing::TestWithParam<int> {
 protected:
  TinyWorld world_{static_cast<std::uint64_t>(GetParam())};
};

TEST_P(ViewGains, UvcCountsUnknownVoxelsBeforeTheFirstOccupiedOne) {
  const double gain = uvc_gain(world_.scene(), world_.T_world_camera);
  EXPECT_EQ(gain, static_cast<double>(world_.unknown_before_occupied().size()));
  EXPECT_GT(gain, 50.0);
}

TEST_P(ViewGains, UvpcWeighsThemByTheirDistanceToFruits) {
  double sum = 0.0;
  for (const auto& [key, voxel] : world_.unknown_before_occupied()) {
    const double d = world_.fruit_distance(voxel);
    if (d < 0.1) sum += 0.5 + (0.1 - d) / 0.1;
  }
  EXPECT_GT(sum, 10.0);
  EXPECT_NEAR(uvpc_gain(world_.scene(), world_.T_world_camera), sum, 1e-9 * sum);
}

TEST_P(ViewGains, OaeSumsTheEntropyThatCanBeSeen) {
  double sum = 0.0;
  for (const auto& [key, seen] : world_.visible()) {
    sum += entropy(probability(world_.map.occupancy_log_odds(seen.first))) * seen.second;
  }
  EXPECT_GT(sum, 50.0);
  EXPECT_NEAR(oae_gain(world_.scene(), world_.T_world_camera), sum, 1e-9 * sum);
}

TEST_P(ViewGains, OsamcepSumsThatOfTheClassAroundFruits) {
  double sum = 0.0;
  for (const auto& [key, seen] : world_.visible()) {
    const bool unknown = world_.map.occupancy(seen.first) == Occupancy::unknown;
    if (world_.map.is_roi(seen.first) || (unknown && world_.fruit_distance(seen.first) < 0.1)) {
      sum += entropy(probability(world_.map.roi_log_odds(seen.first))) * seen.second;
    }
  }
  EXPECT_GT(sum, 5.0);
  EXPECT_NEAR(osamcep_gain(world_.scene(), world_.T_world_camera), sum, 1e-9 * sum);
}

TEST_P(ViewGains, DistancesToFruitsAreExactWithinReach) {
  int within = 0;
  for (int x = -20; x <= 20; x += 3) {
    for (int y = -20; y <= 20; y += 3) {
      for (int z = -5; z < 30; z += 3) {
        const VoxelIndex voxel(x, y, z);
        const double d = world_.fruit_distance(voxel);
        const auto found = world_.distance.at(voxel);
        if (d < 0.1 - 1e-9) {
          ASSERT_TRUE(found.has_value());
          ASSERT_NEAR(*found, d, 1e-12);
          ++within;
        } else if (d > 0.1 + 1e-9) {
          ASSERT_FALSE(found.has_value());
        }
      }
    }
  }
  EXPECT_GT(within, 50);
}

INSTANTIATE_TEST_SUITE_P(Worlds, ViewGains, ::testing::Range(1, 6));

TEST(FruitDistance, OfNoFruitIsNone) {
  FruitDistance distance;
  EXPECT_FALSE(distance.at(VoxelIndex::Zero()).has_value());
  distance.rebuild(VoxelMap(), Box(Vec3::Constant(-1.0), Vec3::Constant(1.0)));
  EXPECT_FALSE(distance.at(VoxelIndex::Zero()).has_value());
}

}  // namespace
}  // namespace canopeer
