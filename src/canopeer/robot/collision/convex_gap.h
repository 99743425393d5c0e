#pragma once

#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// A lower bound on the distance between two shapes, a mesh standing for the convex solid around
/// it; not above 0: they may touch. The widest gap between two parallel planes that hold the shapes
/// apart, over the directions of their faces and the one from centre to centre: exact where faces
/// face each other.
[[nodiscard]] double convex_gap(const CollisionShape& a, const CollisionShape& b,
                                const Pose& T_a_b);

}  // namespace canopeer
