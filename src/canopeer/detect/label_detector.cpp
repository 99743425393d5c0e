#include "canopeer/detect/label_detector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr int kLabels = 4;
using Voices = std::array<int, kLabels>;

/// Labels in the window around a pixel, of pixels on the same surface.
Voices voices_around(const RgbdFrame& frame, int u0, int v0, const LabelDetectorOptions& options) {
  const int r = options.majority_radius_px;
  const auto step = static_cast<float>(options.depth_step_m);
  const float z0 = frame.depth.at(u0, v0);
  Voices voices{};
  for (int v = std::max(0, v0 - r); v <= std::min(frame.depth.height() - 1, v0 + r); ++v) {
    for (int u = std::max(0, u0 - r); u <= std::min(frame.depth.width() - 1, u0 + r); ++u) {
      if (std::abs(frame.depth.at(u, v) - z0) > step) continue;
      ++voices[static_cast<std::size_t>(frame.labels.at(u, v))];
    }
  }
  return voices;
}

/// Fruit or not first, by all fruit labels together; then which.
PixelLabel majority(const Voices& voices) {
  const int fruit = voices[1] + voices[2] + voices[3];
  if (fruit <= voices[0]) return PixelLabel::background;
  return static_cast<PixelLabel>(std::max_element(voices.begin() + 1, voices.end()) -
                                 voices.begin());
}

}  // namespace

LabelDetector::LabelDetector(const LabelDetectorOptions& options) : options_(options) {
  CANOPEER_CHECK(options.validate().has_value(), "validate options where they come from");
}

Expected<Detection> LabelDetector::detect(const RgbdFrame& frame) const {
  const int width = frame.depth.width();
  const int height = frame.depth.height();
  if (frame.labels.width() != width || frame.labels.height() != height) {
    return fail("the detector 'labels' needs frames with labels, and this camera gives none");
  }
  Detection detection{Image<PixelLabel>(width, height), Mask(width, height),
                      Image<float>(width, height)};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!(frame.depth.at(u, v) > 0.0F)) continue;
      const Voices voices = voices_around(frame, u, v, options_);
      const PixelLabel label = majority(voices);
      if (label == PixelLabel::background) continue;
      const int all = voices[0] + voices[1] + voices[2] + voices[3];
      const double share = static_cast<double>(all - voices[0]) / all;
      detection.label.at(u, v) = label;
      detection.confidence.at(u, v) = static_cast<float>(options_.confidence * share);
      if (counted_fruit(label)) detection.fruit.at(u, v) = static_cast<std::uint8_t>(label);
    }
  }
  return detection;
}

Expected<void> LabelDetectorOptions::validate() const {
  if (majority_radius_px < 0 || majority_radius_px > 10) {
    return fail("majority_radius_px must be in 0..10");
  }
  if (!(depth_step_m > 0.0)) return fail("depth_step_m must be positive");
  if (confidence < 0.0 || confidence > 1.0) return fail("confidence must be in 0..1");
  return {};
}

}  // namespace canopeer
