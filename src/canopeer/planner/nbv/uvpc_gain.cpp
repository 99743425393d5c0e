#include "canopeer/planner/nbv/view_gains.h"

namespace canopeer {

double uvpc_gain(const GainScene& scene, const Pose& T_world_camera) {
  const ViewCast cast = cast_view(scene.map, T_world_camera, scene.fan);
  return cast.unknown.weighted_count([&](const VoxelIndex& voxel) {
    const auto distance_m = scene.fruit.at(voxel);
    return distance_m ? 0.5 + (0.1 - *distance_m) / 0.1 : 0.0;
  });
}

}  // namespace canopeer
