#pragma once

#include "canopeer/robot/robot_model.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// A ball that holds a fruit's body.
struct FruitBall {
  Vec3 centre = Vec3::Zero();
  double radius_m = 0.0;
};

/// Where the camera is, up to so much: its optical frame may lie `shift_m` beside `T` and be turned
/// by `turn_rad` against it, about any axis.
struct CameraCell {
  Pose T = Pose::Identity();
  double shift_m = 0.0;
  double turn_rad = 0.0;
};

/// The space in front of a camera in which a fruit is taken notice of.
class Frustum {
 public:
  /// Depth along the axis, from the camera's least to `max_depth_m`.
  Frustum(const CameraIntrinsics& camera, double max_depth_m);

  /// False: from nowhere in the cell any part of the ball lies in it. True proves nothing. Ball and
  /// cell in one frame. Planes through the camera: at angle φ from one, a point can be turned to
  /// φ ± turn; depth likewise.
  [[nodiscard]] bool may_hold(const FruitBall& ball, const CameraCell& cell) const;
  /// Any point of it is no farther from the camera than this.
  [[nodiscard]] double farthest_m() const { return farthest_m_; }

 private:
  double min_depth_m_;
  double max_depth_m_;
  double farthest_m_ = 0.0;
  Vec3 sides_[4];  // normals inwards, unit, camera frame
};

/// All configurations with joint i within half[i] of centre[i].
struct JointBox {
  Configuration centre;
  Configuration half;
};

/// The camera of all of them, arm base frame. Joints are turned one by one from the tool to the
/// base: joint i moves the camera by no more than half[i] times its distance from the joint's axis,
/// which is what it is at the centre and what the joints behind it have added. `arms`: that
/// distance, by joint. Not for robots with followers.
[[nodiscard]] CameraCell camera_cell(const RobotModel& robot, const JointBox& box,
                                     Configuration* arms = nullptr);

/// The camera is never farther from the origin of the arm's base frame than this, m.
[[nodiscard]] double camera_reach_m(const RobotModel& robot);

}  // namespace canopeer
