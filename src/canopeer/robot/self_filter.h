#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/robot/robot_model.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// How near to a link a point is the link.
struct SelfFilterOptions {
  /// A point this near to a link is taken for the link: noise of the depth, errors of the hand-eye
  /// calibration. What really is that near is not seen then.
  double padding_m = 0.01;
};

/// Takes the robot's own links out of depth images, so that they do not end up in the map. By the
/// shapes the collision checks use; a link without one stays in. Const members are thread-safe.
class SelfFilter {
 public:
  /// `robot` must outlive the filter.
  explicit SelfFilter(const RobotModel& robot, const SelfFilterOptions& options = {});

  /// Makes the depth negative (FusionOptions: such pixels say nothing) of every pixel whose point
  /// lies in a link or within the padding of one. `q` and `trolley`: where the robot was when the
  /// frame was taken. Returns the number of pixels.
  std::int64_t mask(RgbdFrame& frame, const Configuration& q, const TrolleyState& trolley) const;

 private:
  struct Shape {
    int link = 0;
    CollisionShape shape;
    double radius_m = 0.0;  // of a ball around its origin that holds it
  };

  std::int64_t mask(RgbdFrame& frame, const Shape& shape, const Pose& T_camera_shape) const;

  const RobotModel* robot_;
  SelfFilterOptions options_;
  std::vector<Shape> shapes_;
};

}  // namespace canopeer
