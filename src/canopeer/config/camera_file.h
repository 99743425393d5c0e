#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/depth_file.h"

namespace canopeer {

/// The camera of a recorded data set.
struct CameraFile {
  /// Width and height are 0 when the file does not say them.
  CameraIntrinsics intrinsics;
  DepthUnits depth{5000.0, 0.0};
  /// `fy_px` is negative: the camera's y axis points up, so the poses are left-handed.
  bool y_up = false;
};

/// Reads a YAML file with `fx_px`, `fy_px`, `cx_px`, `cy_px` (required), `width_px`, `height_px`,
/// `depth_units_per_m` and `max_depth_m`. As in the TUM data sets, ROS and OpenCV, the centre of
/// the upper left pixel is (0, 0).
[[nodiscard]] Expected<CameraFile> load_camera(const std::filesystem::path& path);

/// The same from the four numbers.
[[nodiscard]] CameraIntrinsics intrinsics_of(double fx_px, double fy_px, double cx_px,
                                             double cy_px);

}  // namespace canopeer
