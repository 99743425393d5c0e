#include "canopeer/map/cloud_fusion.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ball_scene.h"
#include "octomap_oracle.h"
#include "same_map.h"

namespace canopeer {
namespace {

// Focal length and depth are short binary fractions: the frame's points are exact in single
// precision, so that frame and cloud hold the same points.
CameraIntrinsics binary_camera() {
  CameraIntrinsics k = CameraIntrinsics::from_fov(160, 120, 1.396);
  k.fx = k.fy = 128.0;
  return k;
}

BallScene::View binary_view(std::uint64_t seed, const std::string& stream) {
  Rng rng(seed, stream);
  const BallScene scene = BallScene::random(seed, 60);
  auto view = scene.render(BallScene::random_camera(rng), binary_camera());
  for (float& depth : view.frame.depth.pixels()) depth = std::round(depth * 1024.0F) / 1024.0F;
  return view;
}

struct Cloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> roi;
  Pose T_world_camera;

  explicit Cloud(const BallScene::View& view) : T_world_camera(view.frame.T_world_camera) {
    for (int v = 0; v < view.frame.depth.height(); ++v) {
      for (int u = 0; u < view.frame.depth.width(); ++u) {
        const double depth = static_cast<double>(view.frame.depth.at(u, v));
        points.emplace_back((depth * view.frame.intrinsics.ray(u, v)).cast<float>());
        roi.push_back(view.roi.at(u, v) != 0 ? 0.9F : 0.1F);
      }
    }
  }
  [[nodiscard]] CloudScan scan() const { return {points, T_world_camera, Vec3::Zero(), roi}; }
};

VoxelMap empty_map(double resolution_m) {
  VoxelMapOptions options;
  options.resolution_m = resolution_m;
  return VoxelMap(options);
}

TEST(CloudFusion, AFrameTurnedIntoACloudGivesTheMapOfTheExactMode) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    VoxelMap by_frame = empty_map(0.02), by_cloud = empty_map(0.02);
    for (const char* stream : {"first", "second"}) {
      const auto view = binary_view(seed, stream);
      const FuseResult a = fuse_exact(by_frame, view.frame, view.roi);
      const FuseResult b = fuse_cloud(by_cloud, Cloud(view).scan());
      EXPECT_EQ(a.fused_points, b.fused_points);
      EXPECT_EQ(a.newly_known, b.newly_known);
      EXPECT_EQ(a.updated_voxels, b.updated_voxels);
      EXPECT_EQ(a.changed, b.changed);
    }
    EXPECT_GT(by_cloud.roi_voxels(), 0);
    expect_same_map(by_frame, by_cloud);
  }
}

TEST(CloudFusion, IsOctoMapVoxelByVoxelOnRandomScenes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Rng rng(seed, "cloud");
    VoxelMap map = empty_map(0.05);
    octomap::OcTree tree(0.05);
    for (int scan = 0; scan < 3; ++scan) {
      const Eigen::Vector3f origin{static_cast<float>(rng.uniform(-0.4, 0.4)),
                                   static_cast<float>(rng.uniform(-0.4, 0.4)),
                                   static_cast<float>(rng.uniform(-0.4, 0.4))};
      std::vector<Eigen::Vector3f> points;
      octomap::Pointcloud cloud;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 p{rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)};
        points.emplace_back(p.cast<float>());
        cloud.push_back(points.back().x(), points.back().y(), points.back().z());
      }
      CloudFusionOptions options;
      options.max_range_m = 1.6;  // a good part is beyond
      fuse_cloud(map, {points, Pose::Identity(), origin.cast<double>(), {}}, options);
      tree.insertPointCloud(cloud, octomap::point3d(origin.x(), origin.y(), origin.z()), 1.6);
    }
    const auto [compared, different] = compare(map, tree);
    EXPECT_GT(compared, 20000);
    EXPECT_EQ(different, 0) << "seed " << seed;
    EXPECT_EQ(compared, map.observed_voxels()) << "seed " << seed;
  }
}

TEST(CloudFusion, OneThreadAndManyAndAnyOrderOfPointsGiveTheSameMap) {
  Cloud cloud(binary_view(5, "camera"));
  const auto run = [&](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    VoxelMap map = empty_map(0.01);
    fuse_cloud(map, cloud.scan());
    return map;
  };
  const VoxelMap one = run(1);
  expect_same_map(one, run(2));
  expect_same_map(one, run(4));
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.roi.begin(), cloud.roi.end());
  expect_same_map(one, run(3));
}

TEST(CloudFusion, AHitBeatsTheRaysThroughItsVoxel) {
  // The second point lies behind the first one.
  const std::vector<Eigen::Vector3f> points = {{0.505F, 0.005F, 0.005F}, {1.005F, 0.005F, 0.005F}};
  VoxelMap map = empty_map(0.01);
  const FuseResult result =
      fuse_cloud(map, {points, Pose::Identity(), Vec3(0.005, 0.005, 0.005), {}});
  EXPECT_EQ(map.occupancy({50, 0, 0}), Occupancy::occupied);
  EXPECT_EQ(map.occupancy({100, 0, 0}), Occupancy::occupied);
  EXPECT_EQ(map.occupancy({75, 0, 0}), Occupancy::free);
  EXPECT_NEAR(map.occupancy_log_odds({20, 0, 0}), std::log(0.4 / 0.6), 2.5e-4);  // once, not twice
  EXPECT_EQ(result.fused_points, 2);
  EXPECT_EQ(result.updated_voxels, 101);
}

TEST(CloudFusion, PointsThatAreNoPointsCountForNothing) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> points = {{nan, 0, 0},     {0, inf, 1},   {0, 0, -inf},
                                               {0, 0, 0},       {0.05F, 0, 0}, {1e30F, 0, 0},
                                               {0, 3.4e38F, 0}, {0, 0, 10001}};
  VoxelMap map = empty_map(0.01);
  CloudFusionOptions options;
  options.min_range_m = 0.1;
  const FuseResult result = fuse_cloud(map, {points, Pose::Identity(), Vec3::Zero(), {}}, options);
  EXPECT_EQ(result.fused_points, 0);
  EXPECT_EQ(map.observed_voxels(), 0);
  EXPECT_EQ(fuse_cloud(map, {}).fused_points, 0);
}

TEST(CloudFusion, SpaceIsFreedUpToTheRangeEvenWhenAPointIsVeryFar) {
  for (const float far : {1.0F, 9000.0F}) {
    const std::vector<Eigen::Vector3f> points = {{far, 0.004F, 0.004F}};
    VoxelMap map = empty_map(0.01);
    CloudFusionOptions options;
    options.max_range_m = 0.5;
    EXPECT_EQ(fuse_cloud(map, {points, Pose::Identity(), Vec3(0.004, 0.004, 0.004), {}}, options)
                  .fused_points,
              0);
    EXPECT_EQ(map.occupied_voxels(), 0);
    EXPECT_EQ(map.observed_voxels(), 50);
  }
}

TEST(CloudFusion, AVoxelIsFruitWhenOneOfItsPointsIs) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> points = {
      {0.501F, 0, 0}, {0.502F, 0, 0}, {0, 0.501F, 0}, {0, 0, 0.501F}};
  const std::vector<float> roi = {0.2F, 0.8F, 0.3F, nan};
  VoxelMap map = empty_map(0.01);
  fuse_cloud(map, {points, Pose::Identity(), Vec3::Zero(), roi});
  EXPECT_NEAR(map.roi_log_odds({50, 0, 0}), std::log(0.7 / 0.3), 2.5e-4);
  EXPECT_NEAR(map.roi_log_odds({0, 50, 0}), std::log(0.4 / 0.6), 2.5e-4);
  EXPECT_EQ(map.roi_log_odds({0, 0, 50}), 0.0);
  EXPECT_EQ(map.roi_voxels(), 1);
}

TEST(CloudFusion, APoseTheMapCannotHoldIsAnErrorBeforehand) {
  const VoxelMap map = empty_map(0.01);
  CloudScan scan;
  EXPECT_TRUE(check_placement(map, scan).has_value());
  scan.T_world_points.translation() = Vec3(1e6, 0, 0);
  EXPECT_NE(check_placement(map, scan).error().message.find("83885 m"), std::string::npos)
      << check_placement(map, scan).error().message;
  scan.T_world_points.translation() = Vec3(0, std::nan(""), 0);
  EXPECT_FALSE(check_placement(map, scan).has_value());
}

}  // namespace
}  // namespace canopeer
