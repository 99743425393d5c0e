#include "canopeer/sim/true_gain.h"

#include <cmath>
#include <map>
#include <vector>

#include "canopeer/render/renderer.h"

namespace canopeer {
namespace {

CameraIntrinsics small_camera(const ViewFan& fan, const TrueGainOptions& options) {
  CameraIntrinsics camera;
  camera.width = options.width_px;
  camera.height = options.height_px;
  camera.fx = options.width_px / 2.0 / std::tan(fan.fov_x_rad / 2.0);
  camera.fy = options.height_px / 2.0 / std::tan(fan.fov_y_rad / 2.0);
  camera.cx = options.width_px / 2.0;
  camera.cy = options.height_px / 2.0;
  camera.max_range_m = options.max_range_m;
  return camera;
}

VoxelSet as_set(const std::map<BlockKey, VoxelMask>& masks) {
  std::vector<VoxelSet::Block> blocks;
  for (const auto& [key, mask] : masks) blocks.push_back({key, mask});
  return VoxelSet(std::move(blocks));
}

}  // namespace

struct TrueGain::Impl {
  Renderer renderer;
  CameraIntrinsics camera;
  CameraRays rays;
  std::vector<bool> counted;  // by fruit
};

TrueGain::TrueGain(const Scene& scene, const ViewFan& fan, const TrueGainOptions& options) {
  const CameraIntrinsics camera = small_camera(fan, options);
  impl_.reset(new Impl{Renderer(scene, {.color_noise = 0.0}), camera, CameraRays(camera), {}});
  for (const FruitTruth& fruit : scene.fruits) impl_->counted.push_back(fruit.counted);
}

TrueGain::~TrueGain() = default;

VoxelSet TrueGain::fruit_voxels(const Pose& T_world_camera, double resolution_m) const {
  const RenderedView view = impl_->renderer.render(impl_->rays, T_world_camera);
  std::map<BlockKey, VoxelMask> masks;
  for (int v = 0; v < impl_->camera.height; ++v) {
    for (int u = 0; u < impl_->camera.width; ++u) {
      const int fruit = view.labels.fruit.at(u, v);
      const double depth_m = view.depth.at(u, v);
      if (fruit < 0 || depth_m <= 0.0 || !impl_->counted[static_cast<std::size_t>(fruit)]) continue;
      const Vec3 p_world = T_world_camera * (depth_m * impl_->camera.ray(u, v));
      const VoxelIndex voxel = voxel_at(p_world, resolution_m);
      masks[block_key(voxel)].set(voxel);
    }
  }
  return as_set(masks);
}

ViewCast TrueGain::cast(const VoxelMap& map, const Pose& T_world_camera) const {
  std::map<BlockKey, VoxelMask> unseen;
  fruit_voxels(T_world_camera, map.resolution_m()).for_each([&](const VoxelIndex& voxel) {
    if (map.occupancy(voxel) == Occupancy::unknown) unseen[block_key(voxel)].set(voxel);
  });
  ViewCast cast;
  cast.unknown = as_set(unseen);
  // What is left out is known already and stays so.
  cast.touched = BlockSet(cast.unknown.keys());
  return cast;
}

}  // namespace canopeer
