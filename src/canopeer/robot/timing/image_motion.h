#pragma once

#include <vector>

#include "canopeer/robot/robot_model.h"
#include "canopeer/robot/timing/blended_path.h"

namespace canopeer {

/// How fast the image of the camera at the arm moves (image_speed()) along a path in joint space,
/// per unit of its length. Followed at a rate ṡ, the image moves ṡ times as fast: a limit on image
/// motion is one on ṡ.
class ImageMotion {
 public:
  /// `robot` must outlive it. Distance and speed of the limit > 0.
  ImageMotion(const RobotModel& robot, const ImageMotionLimit& limit);

  [[nodiscard]] double limit_px_s() const { return limit_.speed_px_s; }
  /// Where the path passes `q` along `tangent` (the derivative by its length), px a unit. Allocates
  /// nothing.
  [[nodiscard]] double along(const Configuration& q, const Configuration& tangent) const;
  /// A bound K on how the speed of any image point bends: on a stretch of the piece of length h,
  /// along() is nowhere more than its larger value at the two ends plus K·h²/8. The camera's twist
  /// is a chord and a rest of at most h²/8 of its second derivative; image speed is convex in the
  /// twist. px a unit cubed.
  [[nodiscard]] double bend(const BlendedPath::Piece& piece) const;

 private:
  const RobotModel* robot_;
  ImageMotionLimit limit_;
};

}  // namespace canopeer
