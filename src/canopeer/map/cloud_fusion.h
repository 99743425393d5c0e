#pragma once

#include <span>

#include "canopeer/base/expected.h"
#include "canopeer/map/fusion.h"

namespace canopeer {

/// A scan without pixel order: what lidars, stereo matchers and recorded clouds give.
struct CloudScan {
  std::span<const Eigen::Vector3f> points;  ///< in frame `points`, any order
  Pose T_world_points = Pose::Identity();
  /// Where the rays start, frame of the points: zero when they are given in the sensor's frame.
  Vec3 origin = Vec3::Zero();
  /// Per point how sure it is fruit, 0 … 1; NaN: nobody looked. Empty: the scan is not segmented.
  std::span<const float> roi_confidence;
};

/// No sensor of a robot measures that far: 1e30 is what some write when nothing came back.
inline constexpr double kNoReturn_m = 10000.0;

/// Which points of a cloud count when it is fused.
struct CloudFusionOptions {
  double max_range_m = 3.0;         ///< farther points are no end points; space is freed up to here
  double min_range_m = 0.0;         ///< nearer points (the sensor's own housing) count for nothing
  float min_roi_confidence = 0.5F;  ///< from here on a point is fruit

  [[nodiscard]] Expected<void> validate() const;
};

/// An error when the scan cannot be placed in the map: pose not finite, or farther from the world's
/// origin than voxel indices reach.
[[nodiscard]] Expected<void> check_placement(const VoxelMap& map, const CloudScan& scan,
                                             const CloudFusionOptions& options = {});

/// Fuses one scan as fuse_exact fuses a frame: every voxel at most once. Voxels that hold an end
/// point get a hit; of the others, those that a ray crosses before its end get a miss. ROI log-odds
/// change in voxels with end points that somebody looked at: a hit when one of them is fruit, else
/// a miss. Points that are not finite, at the origin or beyond kNoReturn_m count for nothing.
/// `roi_confidence` is empty or as long as `points`; check_placement() holds. In parallel; the
/// result depends neither on the number of threads nor on the order of the points.
FuseResult fuse_cloud(VoxelMap& map, const CloudScan& scan, const CloudFusionOptions& options = {});

}  // namespace canopeer
