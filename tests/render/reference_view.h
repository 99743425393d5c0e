#pragma once

#include <vector>

#include "canopeer/render/rays/ray_caster.h"
#include "canopeer/render/renderer.h"

namespace canopeer::testing_support {

/// A view found and shaded pixel by pixel, the plain way: a ray each, Embree's hits, light as in a
/// textbook. For scenes without copies of plants.
struct ReferenceView {
  std::vector<RayCaster::Hit> hits;     ///< row by row
  std::vector<Eigen::Vector3f> colors;  ///< without noise
};
ReferenceView reference_view(const Scene& scene, const CameraRays& rays, const Pose& T_world_camera,
                             const RenderOptions& options = {});

}  // namespace canopeer::testing_support
