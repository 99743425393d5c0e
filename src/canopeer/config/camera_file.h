#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// The camera of a recorded data set.
struct CameraFile {
  /// Width and height are 0 when the file does not say them.
  CameraIntrinsics intrinsics;
  double depth_units_per_m = 5000.0;  ///< what a metre is in the depth images
};

/// Reads a YAML file with `fx_px`, `fy_px`, `cx_px`, `cy_px` (required), `width_px`, `height_px`
/// and `depth_units_per_m`. As in the TUM data sets, ROS and OpenCV, the centre of the upper left
/// pixel is (0, 0).
[[nodiscard]] Expected<CameraFile> load_camera(const std::filesystem::path& path);

/// The same from the four numbers.
[[nodiscard]] CameraIntrinsics intrinsics_of(double fx_px, double fy_px, double cx_px,
                                             double cy_px);

}  // namespace canopeer
