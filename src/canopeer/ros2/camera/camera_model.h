#pragma once

#include <memory>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/rectification.h"

namespace canopeer::ros {

/// What a camera info says of images of one size.
struct CameraModel {
  CameraIntrinsics intrinsics;                        ///< of the images without the lens
  std::shared_ptr<const Rectification> without_lens;  ///< null: there is no lens to take out
};

/// Of images as they come from the camera (`raw`: K and D count) or rectified ones (P counts).
/// Region of interest and binning are looked at; images of another size than the info says, but of
/// the same shape, are scaled ones. In ROS the centre of the upper left pixel is (0, 0), here it is
/// (0.5, 0.5). Models plumb_bob, rational_polynomial and equidistant. Depth range: the defaults.
/// The error: the camera is not calibrated, another model, or the shape is another.
[[nodiscard]] Expected<CameraModel> camera_model(const sensor_msgs::CameraInfo& info, int width,
                                                 int height, bool raw);

/// The same camera with images of another size.
[[nodiscard]] CameraIntrinsics scaled(const CameraIntrinsics& camera, int width, int height);

}  // namespace canopeer::ros
