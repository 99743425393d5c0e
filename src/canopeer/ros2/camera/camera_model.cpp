#include "canopeer/ros2/camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "canopeer/ros2/camera/raw_image.h"

namespace canopeer::ros {
namespace {

using Eigen::Vector2d;

/// Images may be cut by a row or column when they are scaled.
constexpr double kShapeTolerance = 0.01;

/// Up to eight numbers: k1, k2, p1, p2, k3, k4, k5, k6, as in OpenCV; plumb_bob has the first five.
Rectification::Lens radial_lens(std::array<double, 8> d) {
  const auto distort = [d](const Vector2d& p) -> Vector2d {
    const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
    const double radial = (1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]))) /
                          (1.0 + r2 * (d[5] + r2 * (d[6] + r2 * d[7])));
    return {x * radial + 2.0 * d[2] * x * y + d[3] * (r2 + 2.0 * x * x),
            y * radial + d[2] * (r2 + 2.0 * y * y) + 2.0 * d[3] * x * y};
  };
  return [distort](const Vector2d& p) -> Vector2d {
    const Vector2d seen = distort(p);
    // Far outside of what was calibrated the polynomial turns back, over the image again.
    constexpr double kStep = 1.001;
    if (distort(kStep * p).squaredNorm() >= seen.squaredNorm()) return seen;
    return Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  };
}

/// Kannala & Brandt, "A generic camera model …", PAMI 2006, as OpenCV's fisheye.
Rectification::Lens equidistant_lens(std::array<double, 8> d) {
  return [d](const Vector2d& p) -> Vector2d {
    const double r = p.norm();
    if (r < 1e-9) return p;
    const double a = std::atan(r), a2 = a * a;
    return p * (a * (1.0 + a2 * (d[0] + a2 * (d[1] + a2 * (d[2] + a2 * d[3])))) / r);
  };
}

Expected<Rectification::Lens> lens_of(const sensor_msgs::CameraInfo& info) {
  const auto is_zero = [](double value) { return value == 0.0; };
  if (std::all_of(info.d.begin(), info.d.end(), is_zero)) return Rectification::Lens();
  const std::string& model = info.distortion_model;
  const bool fisheye = model == "equidistant" || model == "fisheye" || model == "kannala_brandt4";
  const bool radial = model == "plumb_bob" || model == "rational_polynomial" || model.empty();
  if (!fisheye && !radial) {
    return fail("the camera info's distortion model is '" + model +
                "'; plumb_bob, rational_polynomial and equidistant are known: give the topics of "
                "rectified images (image_proc makes them)");
  }
  std::array<double, 8> d{};
  const std::size_t known = fisheye ? 4 : 8;
  if (info.d.size() > known &&
      !std::all_of(info.d.begin() + static_cast<std::ptrdiff_t>(known), info.d.end(), is_zero)) {
    return fail("the camera info has " + std::to_string(info.d.size()) + " numbers of model '" +
                model + "', of which " + std::to_string(known) +
                " are known: give the topics of rectified images (image_proc makes them)");
  }
  std::copy_n(info.d.begin(), std::min(known, info.d.size()), d.begin());
  if (!std::all_of(d.begin(), d.end(), [](double value) { return std::isfinite(value); })) {
    return fail("the camera info's distortion has numbers that are none");
  }
  return fisheye ? equidistant_lens(d) : radial_lens(d);
}

/// The pinhole of the images that the info is about: region of interest and binning applied.
Expected<CameraIntrinsics> pinhole_of(const sensor_msgs::CameraInfo& info, bool raw) {
  const bool from_p = !raw && info.p[0] > 0.0;
  const double fx = from_p ? info.p[0] : info.k[0], fy = from_p ? info.p[5] : info.k[4];
  const double cx = from_p ? info.p[2] : info.k[2], cy = from_p ? info.p[6] : info.k[5];
  const auto& roi = info.roi;
  const double bin_x = std::max(info.binning_x, 1u), bin_y = std::max(info.binning_y, 1u);
  const double width = (roi.width != 0 ? roi.width : info.width) / bin_x;
  const double height = (roi.height != 0 ? roi.height : info.height) / bin_y;
  if (auto size =
          check_image_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
      !size) {
    return fail_in("the camera info", size.error());
  }
  CameraIntrinsics camera;
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  camera.fx = fx / bin_x;
  camera.fy = fy / bin_y;
  camera.cx = (cx + 0.5 - roi.x_offset) / bin_x;
  camera.cy = (cy + 0.5 - roi.y_offset) / bin_y;
  const bool plausible = fx > 1.0 && fy > 1.0 && std::isfinite(fx) && std::isfinite(fy) &&
                         std::isfinite(cx) && std::isfinite(cy);
  if (!plausible) {
    return fail("the camera info has no calibration (its focal length is " + std::to_string(fx) +
                "): calibrate the camera, or give its driver the calibration file");
  }
  return camera;
}

}  // namespace

CameraIntrinsics scaled(const CameraIntrinsics& camera, int width, int height) {
  const double x = static_cast<double>(width) / camera.width;
  const double y = static_cast<double>(height) / camera.height;
  CameraIntrinsics other = camera;
  other.width = width;
  other.height = height;
  other.fx *= x;
  other.cx *= x;
  other.fy *= y;
  other.cy *= y;
  return other;
}

Expected<CameraModel> camera_model(const sensor_msgs::CameraInfo& info, int width, int height,
                                   bool raw) {
  const auto said = pinhole_of(info, raw);
  if (!said) return tl::unexpected(said.error());
  const double shape = static_cast<double>(said->width) * height / said->height / width;
  if (std::abs(shape - 1.0) > kShapeTolerance) {
    return fail("images are " + std::to_string(width) + " x " + std::to_string(height) +
                ", the camera info is about " + std::to_string(said->width) + " x " +
                std::to_string(said->height) + ": is it that of another camera?");
  }
  CameraModel model{scaled(*said, width, height), nullptr};
  if (!raw) return model;
  const auto lens = lens_of(info);
  if (!lens) return tl::unexpected(lens.error());
  if (*lens) {
    model.without_lens =
        std::make_shared<const Rectification>(model.intrinsics, model.intrinsics, *lens);
  }
  return model;
}

}  // namespace canopeer::ros
