#pragma once

#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/camera_rays.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// How far the image of what a camera sees moves while the camera goes from `T_world_before` over
/// `T_world_camera` to `T_world_after`, px along both pieces: nine tenths of the image move no
/// farther (the rest is mostly a leaf close by). `depth` is what it sees from the middle pose;
/// where it sees nothing that counts as very far, what comes too close to be reckoned with as
/// infinitely fast. A grid of pixels is looked at.
[[nodiscard]] double image_motion(const DepthImage& depth, const CameraRays& rays,
                                  const Pose& T_world_before, const Pose& T_world_camera,
                                  const Pose& T_world_after);

}  // namespace canopeer
