#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/sensing/rgbd_frame.h"

// Compressed images as pixels: what image_transport's plugins "compressed" and "compressedDepth"
// send. The same promises as raw_image.h.

namespace canopeer::ros {

/// JPEG or PNG.
[[nodiscard]] Expected<ColorImage> color_of(const sensor_msgs::CompressedImage& message);
/// compressedDepth: 12 octets and a PNG of 16 bits, which are mm ("16UC1; compressedDepth png") or
/// quantised inverse depths ("32FC1; …"). A PNG of mm without the octets ("16UC1; png …") too.
[[nodiscard]] Expected<DepthImage> depth_of(const sensor_msgs::CompressedImage& message);
/// PNG only: JPEG would mix labels.
[[nodiscard]] Expected<Image<PixelLabel>> labels_of(const sensor_msgs::CompressedImage& message);

}  // namespace canopeer::ros
