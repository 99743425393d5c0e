#include "canopeer/map/end_points.h"

#include <cmath>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

// std::floor without the library call it is on baseline x86-64.
int floor_to_int(double v) {
  const int i = static_cast<int>(v);
  return i - (v < i);
}

void check(const RgbdFrame& frame, const Mask& roi, const FusionOptions& options,
           double resolution_m) {
  const CameraIntrinsics& k = frame.intrinsics;
  CANOPEER_CHECK(frame.depth.width() == k.width && frame.depth.height() == k.height,
                 "the depth image must have the size the intrinsics say");
  CANOPEER_CHECK(roi.empty() || (roi.width() == k.width && roi.height() == k.height),
                 "the ROI mask must be empty or as large as the depth image");
  CANOPEER_CHECK(frame.T_world_camera.matrix().allFinite(), "the camera pose must be finite");
  const double reach =
      frame.T_world_camera.translation().cwiseAbs().maxCoeff() + options.max_range_m;
  CANOPEER_CHECK(reach / resolution_m < kBlockSide * (kBlockIndexLimit - 2.0),
                 "the camera is outside the map's index range");
}

}  // namespace

EndPoints find_end_points(const RgbdFrame& frame, const Mask& roi, const FusionOptions& options,
                          double resolution_m) {
  check(frame, roi, options, resolution_m);
  const CameraIntrinsics& k = frame.intrinsics;
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin = frame.T_world_camera.translation();
  EndPoints ends;
  ends.free_depth = DepthImage(k.width, k.height);
  // The part of a ray's direction that depends on its column, and its square in the camera frame.
  std::vector<Vec3> across(static_cast<std::size_t>(k.width));
  std::vector<double> across2(across.size());
  for (int u = 0; u < k.width; ++u) {
    const double x = k.ray(u, 0).x();
    across[static_cast<std::size_t>(u)] = R.col(0) * x;
    across2[static_cast<std::size_t>(u)] = x * x;
  }
  BlockKey last_key = ~BlockKey{0};
  std::uint32_t last_slot = 0;
  for (int v = 0; v < k.height; ++v) {
    const double y = k.ray(0, v).y();
    const Vec3 row_direction = R.col(1) * y + R.col(2);
    for (int u = 0; u < k.width; ++u) {
      const auto column = static_cast<std::size_t>(u);
      const double depth = static_cast<double>(frame.depth.at(u, v));
      const double range_limit = options.max_range_m / std::sqrt(1.0 + y * y + across2[column]);
      if (!(depth > 0.0 && std::isfinite(depth))) {
        if (options.clear_no_return) ends.free_depth.at(u, v) = static_cast<float>(range_limit);
        continue;
      }
      if (depth > range_limit) {
        ends.free_depth.at(u, v) = static_cast<float>(range_limit);
        continue;
      }
      ends.free_depth.at(u, v) = static_cast<float>(depth);
      ++ends.count;
      const Vec3 p = (origin + depth * (row_direction + across[column])) / resolution_m;
      const VoxelIndex voxel(floor_to_int(p.x()), floor_to_int(p.y()), floor_to_int(p.z()));
      const BlockKey key = block_key(voxel);
      if (key != last_key) {
        last_key = key;
        last_slot = ends.directory.find_or_add(key);
        if (last_slot == ends.blocks.size()) ends.blocks.push_back({key, {}, {}});
      }
      ends.blocks[last_slot].hit.set(voxel);
      if (!roi.empty() && roi.at(u, v) != 0) ends.blocks[last_slot].roi.set(voxel);
    }
  }
  return ends;
}

}  // namespace canopeer
