#pragma once

#include <optional>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::ros {

/// An organised cloud as images.
struct CloudImages {
  DepthImage depth;  ///< 0: no point
  ColorImage color;  ///< empty: the cloud has no colours
  /// Of the pinhole that sees each point in its pixel, fitted to the points; nothing when they are
  /// too few to tell (fewer than 100, or all in a line).
  std::optional<CameraIntrinsics> intrinsics;
};

/// Fields x, y, z (m; 32 or 64 bit reals) and rgb or rgba (32 bits) in any order. Any bytes may
/// come. The error: the cloud is not organised, fields are missing, it is damaged, or its points
/// are not those of a pinhole camera in its optical frame (z forward, y down).
[[nodiscard]] Expected<CloudImages> images_of(const sensor_msgs::PointCloud2& cloud);

}  // namespace canopeer::ros
