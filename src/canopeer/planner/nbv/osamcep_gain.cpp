#include "canopeer/planner/nbv/view_gains.h"

namespace canopeer {

double osamcep_gain(const GainScene& scene, const Pose& T_world_camera) {
  double sum = 0.0;
  for (const auto& [voxel, visibility] : visible_voxels(scene, T_world_camera)) {
    const bool unknown = scene.map.occupancy(voxel) == Occupancy::unknown;
    if (!scene.map.is_roi(voxel) && !(unknown && scene.fruit.at(voxel))) continue;
    sum += entropy_bit(scene.map.roi_log_odds(voxel)) * visibility;
  }
  return sum;
}

}  // namespace canopeer
