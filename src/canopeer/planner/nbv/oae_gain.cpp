#include "canopeer/planner/nbv/view_gains.h"

namespace canopeer {

double oae_gain(const GainScene& scene, const Pose& T_world_camera) {
  double sum = 0.0;
  for (const auto& [voxel, visibility] : visible_voxels(scene, T_world_camera)) {
    sum += entropy_bit(scene.map.occupancy_log_odds(voxel)) * visibility;
  }
  return sum;
}

}  // namespace canopeer
