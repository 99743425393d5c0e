#include "canopeer/map/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ball_scene.h"

namespace canopeer {
namespace {

const Box kWorld(Vec3(-0.401, -0.7, -0.53), Vec3(0.93, 0.61, 0.4));

double distance_to_cube(const Vec3& p, const VoxelIndex& voxel, double resolution_m) {
  const Box cube(voxel.cast<double>() * resolution_m,
                 (voxel + VoxelIndex::Ones()).cast<double>() * resolution_m);
  return std::sqrt(cube.squaredExteriorDistance(p));
}

VoxelMap random_map(Rng& rng, int count) {
  VoxelMap map;
  for (int i = 0; i < count; ++i) {
    const Vec3 p{rng.uniform(-0.6, 1.1), rng.uniform(-0.9, 0.8), rng.uniform(-0.7, 0.6)};
    map.set_occupancy_log_odds(voxel_at(p, 0.01), 1.0);
  }
  return map;
}

TEST(DistanceField, IsALowerBoundWithinAVoxelDiagonal) {
  Rng rng(1, "field");
  const VoxelMap map = random_map(rng, 250);
  std::vector<VoxelIndex> occupied;
  map.for_each_occupied(Box(Vec3::Constant(-9), Vec3::Constant(9)),
                        [&](const VoxelIndex& v) { occupied.push_back(v); });
  DistanceField field({kWorld, 0.15}, 0.01);
  field.rebuild(map);
  const double diagonal = 0.01 * std::sqrt(3.0);
  int near = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{rng.uniform(kWorld.min().x(), kWorld.max().x()),
                 rng.uniform(kWorld.min().y(), kWorld.max().y()),
                 rng.uniform(kWorld.min().z(), kWorld.max().z())};
    double truth = 0.15;
    for (const VoxelIndex& v : occupied) truth = std::min(truth, distance_to_cube(p, v, 0.01));
    const double bound = static_cast<double>(field.distance(p));
    near += truth < 0.15;
    ASSERT_LE(bound, truth + 1e-6) << p.transpose();
    ASSERT_GE(bound, truth - diagonal - 1e-6) << p.transpose();
  }
  EXPECT_GT(near, 10000);
}

TEST(DistanceField, UpdatedIsTheSameAsRebuilt) {
  const BallScene scene = BallScene::random(2, 60);
  Rng rng(2, "cameras");
  VoxelMap map;
  const Box world(Vec3(0.2, -0.8, -0.5), Vec3(1.1, 0.8, 0.5));
  DistanceField updated({world, 0.08}, 0.01);
  DistanceField rebuilt({world, 0.08}, 0.01);
  for (int frame = 0; frame < 4; ++frame) {
    const auto view =
        scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(160, 120, 1.396));
    updated.update(map, fuse(map, view.frame, view.roi).changed);
    rebuilt.rebuild(map);
    for (int i = 0; i < 50000; ++i) {
      const Vec3 p{rng.uniform(0.1, 1.2), rng.uniform(-0.9, 0.9), rng.uniform(-0.6, 0.6)};
      ASSERT_EQ(updated.distance(p), rebuilt.distance(p)) << p.transpose();
    }
  }
}

TEST(DistanceField, ForgetsWhatIsNoLongerOccupiedAndKnowsNothingOutside) {
  VoxelMap map = map_of({}, {{10, 10, 10}});
  DistanceField field({Box(Vec3(0, 0, 0), Vec3(0.3, 0.3, 0.3)), 0.1}, 0.01);
  EXPECT_EQ(field.distance(Vec3(0.105, 0.105, 0.105)), 0.1F);
  field.update(map, {block_key({10, 10, 10})});
  EXPECT_EQ(field.distance(Vec3(0.105, 0.105, 0.105)), 0.0F);
  EXPECT_NEAR(field.distance(Vec3(0.155, 0.105, 0.105)), 0.04, 1e-6);
  EXPECT_EQ(field.distance(Vec3(-0.001, 0.105, 0.105)), 0.1F);
  map.set_occupancy_log_odds({10, 10, 10}, -1.0);
  field.update(map, {block_key({10, 10, 10})});
  EXPECT_EQ(field.distance(Vec3(0.105, 0.105, 0.105)), 0.1F);
}

// Unknown space and ROI by the definition, in a map of which parts were never seen.
TEST(DistanceField, MeasuresToUnknownOrRoiVoxelsWhenAsked) {
  const Box world(Vec3(0.3, -0.2, -0.15), Vec3(0.7, 0.2, 0.15));
  const double resolution = 0.02;
  VoxelMapOptions options;
  options.resolution_m = resolution;
  VoxelMap map(options);
  DistanceField to_unknown({world, 0.1, DistanceTo::occupied_or_unknown}, resolution);
  DistanceField to_roi({world, 0.1, DistanceTo::roi}, resolution);
  EXPECT_EQ(to_unknown.distance(Vec3(0.5, 0.0, 0.0)), 0.0F);
  EXPECT_EQ(to_roi.distance(Vec3(0.5, 0.0, 0.0)), 0.1F);
  const BallScene scene = BallScene::random(3, 60);
  Rng rng(3, "cameras");
  for (int frame = 0; frame < 2; ++frame) {
    const auto view =
        scene.render(BallScene::random_camera(rng), CameraIntrinsics::from_fov(160, 120, 1.396));
    const auto changed = fuse(map, view.frame, view.roi).changed;
    to_unknown.update(map, changed);
    to_roi.update(map, changed);
    DistanceField rebuilt({world, 0.1, DistanceTo::occupied_or_unknown}, resolution);
    rebuilt.rebuild(map);
    int positive = 0;
    for (int i = 0; i < 800; ++i) {
      const Vec3 p{rng.uniform(0.3, 0.7), rng.uniform(-0.2, 0.2), rng.uniform(-0.15, 0.15)};
      const VoxelIndex at = voxel_at(p, resolution);
      double unknown = 0.1, roi = 0.1;
      for (int n = 0; n < 13 * 13 * 13; ++n) {
        const VoxelIndex v = at + VoxelIndex(n % 13 - 6, n / 13 % 13 - 6, n / 169 - 6);
        if (map.occupancy(v) != Occupancy::free) {
          unknown = std::min(unknown, distance_to_cube(p, v, resolution));
        }
        if (map.is_roi(v)) roi = std::min(roi, distance_to_cube(p, v, resolution));
      }
      const double diagonal = resolution * std::sqrt(3.0);
      const auto bound = static_cast<double>(to_unknown.distance(p));
      ASSERT_LE(bound, unknown + 1e-6);
      ASSERT_GE(bound, unknown - diagonal - 1e-6);
      ASSERT_EQ(to_unknown.distance(p), rebuilt.distance(p));
      ASSERT_LE(static_cast<double>(to_roi.distance(p)), roi + 1e-6);
      ASSERT_GE(static_cast<double>(to_roi.distance(p)), roi - diagonal - 1e-6);
      positive += bound > 0.0;
    }
    EXPECT_GT(positive, 0);
  }
}

TEST(DistanceField, SeesObstaclesJustOutsideItsBox) {
  DistanceField field({Box(Vec3(0, 0, 0), Vec3(0.3, 0.3, 0.3)), 0.1}, 0.01);
  field.rebuild(map_of({}, {{-3, 5, 5}, {64, 20, 20}}));
  EXPECT_NEAR(field.distance(Vec3(0.005, 0.055, 0.055)), 0.02, 1e-6);
}

}  // namespace
}  // namespace canopeer
