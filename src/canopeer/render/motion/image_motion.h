#pragma once

#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/camera_rays.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// How far the image of what a camera sees moves while the camera goes from `T_world_before` over
/// `T_world_camera` to `T_world_after`, px: along both pieces, where it moves farthest. `depth` is
/// what it sees from the middle pose; where it sees nothing that counts as very far. A grid of
/// pixels is looked at. Infinite where something comes too near to be reckoned with.
[[nodiscard]] double image_motion(const DepthImage& depth, const CameraRays& rays,
                                  const Pose& T_world_before, const Pose& T_world_camera,
                                  const Pose& T_world_after);

}  // namespace canopeer
