#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/sensing/rgbd_frame.h"

// Image messages as pixels. Any bytes may come: sizes are checked before memory is taken. Errors
// say what the message has and what to ask the driver for.

namespace canopeer::ros {

/// Images of more pixels are refused.
inline constexpr std::size_t kMostImagePixels = 32u << 20;

/// No error, or why there can be no image of this size.
[[nodiscard]] Expected<void> check_image_size(std::uint64_t width, std::uint64_t height);

/// rgb8, bgr8, rgba8, bgra8, mono8; rows may be padded.
[[nodiscard]] Expected<ColorImage> color_of(const sensor_msgs::Image& message);
/// 16UC1 or mono16 in mm (0 and 65535: no return), 32FC1 in m (NaN, infinite, ≤ 0: no return), in
/// either byte order. No return is 0 here.
[[nodiscard]] Expected<DepthImage> depth_of(const sensor_msgs::Image& message);
/// mono8 or 8UC1 of PixelLabel's values. The error: another value.
[[nodiscard]] Expected<Image<PixelLabel>> labels_of(const sensor_msgs::Image& message);
/// 32FC1 of 0 … 1, or mono8 or 8UC1 of 0 … 255, as 0 … 1; NaN becomes 0.
[[nodiscard]] Expected<Image<float>> confidences_of(const sensor_msgs::Image& message);

/// Values of PixelLabel from a plain grey image.
[[nodiscard]] Expected<Image<PixelLabel>> labels_from(int width, int height,
                                                      const std::uint8_t* values, std::size_t step);

}  // namespace canopeer::ros
