#include "canopeer/detect/color_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "canopeer/base/check.h"
#include "canopeer/detect/blobs.h"

namespace canopeer {
namespace {

/// Hue, saturation and value of the image: H over the full byte (256 = 360°), S and V 0 … 255.
cv::Mat hsv_of(const ColorImage& color) {
  static_assert(sizeof(Rgb) == 3);
  const cv::Mat rgb(color.height(), color.width(), CV_8UC3,
                    const_cast<Rgb*>(color.pixels().data()));
  cv::Mat hsv;
  cv::cvtColor(rgb, hsv, cv::COLOR_RGB2HSV_FULL);
  return hsv;
}

int hue_byte(double degrees) { return static_cast<int>(std::lround(degrees * 256.0 / 360.0)); }

/// Pixels inside the window; a hue window that starts below 0° wraps around.
cv::Mat in_window(const cv::Mat& hsv, const ColorWindow& window, double min_saturation) {
  const double s = 255.0 * min_saturation;
  const double v = 255.0 * window.min_value;
  const int low = hue_byte(window.hue_low_deg);
  const int high = hue_byte(window.hue_high_deg);
  cv::Mat in;
  cv::inRange(hsv, cv::Scalar(std::max(low, 0), s, v), cv::Scalar(high, 255, 255), in);
  if (low < 0) {
    cv::Mat wrapped;
    cv::inRange(hsv, cv::Scalar(256 + low, s, v), cv::Scalar(std::min(256 + high, 255), 255, 255),
                wrapped);
    in |= wrapped;
  }
  return in;
}

/// Pixels inside any of the windows; `saturation_of` tells how pale each may be.
template <typename SaturationOf>
cv::Mat in_windows(const cv::Mat& hsv, const ColorDetectorOptions& options,
                   const SaturationOf& saturation_of) {
  cv::Mat in = cv::Mat::zeros(hsv.rows, hsv.cols, CV_8U);
  for (const ColorWindow& window : options.windows) {
    in |= in_window(hsv, window, saturation_of(window));
  }
  return in;
}

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

void remove_pixels_without_depth(const DepthImage& depth, cv::Mat& mask) {
  std::uint8_t* in = mask.ptr();
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    if (!(depth.pixels()[i] > 0.0F)) in[i] = 0;
  }
}

/// Pixels that may be filled in when fruit surrounds them: of fruit hue however pale, or a glaring
/// highlight. A stem in front of a fruit is neither.
cv::Mat fillable(const cv::Mat& hsv, const ColorDetectorOptions& options) {
  constexpr double kAnySaturation = 0.1;
  constexpr double kGlaring = 0.9 * 255.0;
  cv::Mat glaring;
  cv::inRange(hsv, cv::Scalar(0, 0, kGlaring), cv::Scalar(255, 120, 255), glaring);
  return glaring | in_windows(hsv, options, [](const ColorWindow&) { return kAnySaturation; });
}

/// Surely fruit-coloured pixels, paler ones (highlights) that touch them, and holes.
cv::Mat fruit_colored(const cv::Mat& hsv, const ColorDetectorOptions& options) {
  cv::Mat sure =
      in_windows(hsv, options, [](const ColorWindow& window) { return window.min_saturation; });
  if (options.opening_radius_px > 0) {
    cv::morphologyEx(sure, sure, cv::MORPH_OPEN, disc(options.opening_radius_px));
  }
  const cv::Mat pale = in_windows(
      hsv, options, [](const ColorWindow& window) { return window.min_saturation_at_fruit; });
  cv::Mat reach;
  constexpr int kSteps = 3;
  for (int step = 0; step < kSteps; ++step) {
    cv::dilate(sure, reach, disc(1));
    sure |= reach & pale;
  }
  if (options.closing_radius_px > 0) {
    cv::Mat closed;
    cv::morphologyEx(sure, closed, cv::MORPH_CLOSE, disc(options.closing_radius_px));
    sure |= closed & fillable(hsv, options);
  }
  return sure;
}

Mask to_mask(const cv::Mat& image) {
  Mask mask(image.cols, image.rows);
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) mask.pixels()[i] = image.data[i] != 0;
  return mask;
}

/// The window whose middle hue is nearest, round the circle.
const ColorWindow& nearest_window(std::uint8_t hue, const std::vector<ColorWindow>& windows) {
  const auto distance = [hue](const ColorWindow& w) {
    const int middle = hue_byte(0.5 * (w.hue_low_deg + w.hue_high_deg));
    const int apart = ((hue - middle) % 256 + 256) % 256;
    return std::min(apart, 256 - apart);
  };
  return *std::min_element(
      windows.begin(), windows.end(),
      [&](const ColorWindow& a, const ColorWindow& b) { return distance(a) < distance(b); });
}

/// Certainty from how saturated the pixel is and how large its blob.
float confidence_of(std::uint8_t saturation, const Blob& blob, const ColorWindow& window) {
  const double margin = (saturation / 255.0 - window.min_saturation_at_fruit) /
                        std::max(1e-6, 1.0 - window.min_saturation_at_fruit);
  const double size = blob.area_cm2 / (blob.area_cm2 + 2.0);
  return static_cast<float>(size * (0.5 + 0.5 * std::clamp(margin, 0.0, 1.0)));
}

}  // namespace

std::vector<bool> in_color_windows(std::span<const Rgb> colors,
                                   const ColorDetectorOptions& options) {
  if (colors.empty()) return {};
  ColorImage row(static_cast<int>(colors.size()), 1);
  std::copy(colors.begin(), colors.end(), row.pixels().begin());
  ColorDetectorOptions counting = options;
  std::erase_if(counting.windows,
                [](const ColorWindow& w) { return w.label == PixelLabel::green_fruit; });
  const cv::Mat in = in_windows(hsv_of(row), counting,
                                [](const ColorWindow& window) { return window.min_saturation; });
  std::vector<bool> result;
  for (int i = 0; i < in.cols; ++i) result.push_back(in.at<std::uint8_t>(0, i) != 0);
  return result;
}

ColorDetector::ColorDetector(const ColorDetectorOptions& options) : options_(options) {
  CANOPEER_CHECK(options.validate().has_value(), "validate options where they come from");
}

Expected<Detection> ColorDetector::detect(const RgbdFrame& frame) const {
  const int width = frame.color.width();
  const int height = frame.color.height();
  CANOPEER_CHECK(width == frame.depth.width() && height == frame.depth.height(),
                 "registered colour and depth images");
  Detection detection{Image<PixelLabel>(width, height), Mask(width, height),
                      Image<float>(width, height)};
  if (frame.color.empty()) return detection;

  const cv::Mat hsv = hsv_of(frame.color);
  cv::Mat colored = fruit_colored(hsv, options_);
  remove_pixels_without_depth(frame.depth, colored);
  const BlobLabels pieces = label_blobs(frame, to_mask(colored), options_.depth_step_m);

  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int label = pieces.label.at(u, v);
      if (label < 0) continue;
      const Blob& blob = pieces.blobs[static_cast<std::size_t>(label)];
      if (blob.pixels < options_.min_blob_px || blob.area_cm2 < options_.min_blob_area_cm2) {
        continue;
      }
      const auto pixel = hsv.at<cv::Vec3b>(v, u);
      const ColorWindow& window = nearest_window(pixel[0], options_.windows);
      detection.label.at(u, v) = window.label;
      if (counted_fruit(window.label)) {
        detection.fruit.at(u, v) = static_cast<std::uint8_t>(window.label);
      }
      detection.confidence.at(u, v) = confidence_of(pixel[1], blob, window);
    }
  }
  return detection;
}

Expected<void> ColorDetectorOptions::validate() const {
  if (windows.empty()) return fail("there must be at least one window");
  for (const ColorWindow& w : windows) {
    if (w.hue_low_deg < -180.0 || w.hue_high_deg > 180.0 || w.hue_low_deg >= w.hue_high_deg) {
      return fail("hue windows must satisfy -180 <= hue_low_deg < hue_high_deg <= 180");
    }
    if (w.min_saturation < 0.0 || w.min_saturation > 1.0) {
      return fail("min_saturation must be in 0..1");
    }
    if (w.min_saturation_at_fruit < 0.0 || w.min_saturation_at_fruit > w.min_saturation) {
      return fail("min_saturation_at_fruit must be in 0..min_saturation");
    }
    if (w.min_value < 0.0 || w.min_value > 1.0) return fail("min_value must be in 0..1");
    if (w.label == PixelLabel::background) return fail("a window needs a ripeness");
  }
  if (opening_radius_px < 0 || closing_radius_px < 0 || opening_radius_px > 20 ||
      closing_radius_px > 20) {
    return fail("opening_radius_px and closing_radius_px must be in 0..20");
  }
  if (min_blob_px < 0 || min_blob_area_cm2 < 0.0) return fail("blob floors must not be negative");
  if (depth_step_m <= 0.0) return fail("depth_step_m must be positive");
  return {};
}

}  // namespace canopeer
