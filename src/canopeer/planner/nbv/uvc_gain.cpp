#include "canopeer/planner/nbv/view_gains.h"

namespace canopeer {

double uvc_gain(const GainScene& scene, const Pose& T_world_camera) {
  return static_cast<double>(cast_view(scene.map, T_world_camera, scene.fan).unknown.count());
}

}  // namespace canopeer
