#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace canopeer {

using Vec3 = Eigen::Vector3d;

/// Rigid motion. `T_a_b` maps points given in frame b to frame a.
using Pose = Eigen::Isometry3d;

/// Axis-aligned box; the frame is in the variable's name.
using Box = Eigen::AlignedBox3d;

/// Pose of an optical frame (x right, y down, z forward) at `position` that looks at `target`. At
/// roll 0 the image is upright: y points as far down, against world z, as it can. A positive roll
/// turns the camera clockwise about its axis. When the axis is vertical, "up" is +x. `target` must
/// differ from `position`.
Pose look_at(const Vec3& position, const Vec3& target, double roll_rad = 0.0);

/// The smallest axis-aligned box in frame a around `box_b` given in frame b.
Box transformed(const Box& box_b, const Pose& T_a_b);

}  // namespace canopeer
