#pragma once

#include "canopeer/geometry/pose.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// How a camera moves, in its own frame (x right, y down, z forward).
struct CameraTwist {
  Vec3 linear = Vec3::Zero();   ///< m/s
  Vec3 angular = Vec3::Zero();  ///< rad/s
};

/// How fast the image of still surfaces moves where it moves fastest, px/s, when all of them lie
/// `distance_m` along the optical axis from the camera: the interaction matrix of a point
/// (Chaumette & Hutchinson, "Visual servo control, part I", IEEE RAM 13(4), 2006, eq. 11), at the
/// image's centre, its corners and the middles of its edges.
[[nodiscard]] double image_speed(const CameraTwist& twist, const CameraIntrinsics& camera,
                                 double distance_m);

/// The twist that leads from one pose to the next in so many seconds.
[[nodiscard]] CameraTwist twist_between(const Pose& T_world_before, const Pose& T_world_after,
                                        double seconds);

}  // namespace canopeer
