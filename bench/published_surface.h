#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/geometry/superellipsoid.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// How the published system turns fruit pixels into fruits (Marangoz et al., CASE 2022, with the
/// settings its launch files have), to be held against ours: pixels become points, points that lie
/// farther from their neighbours than the frame's average are dropped, each of the rest is a ray
/// through a signed distance field, and the voxels next to its surface are clustered.
struct PublishedOptions {
  bool drop_outliers = true;     ///< statistical outlier removal before the distance field
  int neighbours = 5;            ///< of the outlier removal
  double deviations = 0.01;      ///< dropped beyond mean + this · standard deviation
  double voxel_m = 0.004;        ///< of the distance field
  double truncation_voxels = 4;  ///< the distance is known this far from the surface
  double surface_voxels = 0.75;  ///< voxels are surface points up to this distance from it
  double cluster_tolerance_m = 0.01;
  std::size_t min_points = 100;  ///< of a cluster that counts as a fruit
};

/// Mean distance to the nearest neighbours of each pixel's point, looked for among the pixels
/// around it (9 × 9), where the nearest in space are but at edges. No neighbour at all: infinite.
/// `there`: non-zero where there is a point; `pixels`: those asked for, v · width + u.
[[nodiscard]] std::vector<double> neighbour_distances(const Image<Vec3>& points, const Mask& there,
                                                      const std::vector<int>& pixels,
                                                      int neighbours);

/// mean + deviations · standard deviation of the finite ones; infinite: fewer than two are.
[[nodiscard]] double outlier_limit(const std::vector<double>& means, double deviations);

class PublishedSurface {
 public:
  explicit PublishedSurface(const PublishedOptions& options) : options_(options) {}

  /// `fruit`: non-zero where the frame shows fruit.
  void add(const RgbdFrame& frame, const Mask& fruit);
  /// Centres of the clusters (mean of their points), world frame.
  [[nodiscard]] std::vector<Vec3> fruit_centres() const;

 private:
  struct Voxel {
    float distance_m = 0.0F;
    float weight = 0.0F;
  };
  /// A point, world frame, and its distance from the camera along the optical axis.
  struct Seen {
    Vec3 point = Vec3::Zero();
    double depth_m = 0.0;
  };
  [[nodiscard]] std::vector<Seen> points_of(const RgbdFrame& frame, const Mask& fruit) const;
  void cast(const Vec3& origin, const Seen& seen);

  PublishedOptions options_;
  std::unordered_map<std::uint64_t, Voxel> voxels_;  // by voxel_key
};

}  // namespace canopeer
