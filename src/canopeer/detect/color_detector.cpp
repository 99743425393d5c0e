#include "canopeer/detect/color_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

/// Which pixels are how much like a fruit, by colour alone; 255: they are.
struct ColorClasses {
  cv::Mat sure;
  cv::Mat pale;  ///< of fruit hue, too pale to be sure
  /// Those that may be filled in when fruit surrounds them: of fruit hue however pale, or a glaring
  /// highlight. A stem in front of a fruit is neither.
  cv::Mat fillable;
};

/// Ranges of hue, saturation and value, a bit each: a pixel lies in those that all three of its
/// channels have.
class ColorRanges {
 public:
  /// Bytes from first to last.
  struct Range {
    int first = 0;
    int last = 255;
  };
  void add(unsigned bit, const Range& hue, const Range& saturation, const Range& value) {
    add(hue_, bit, hue);
    add(saturation_, bit, saturation);
    add(value_, bit, value);
  }
  [[nodiscard]] std::uint64_t of(const std::uint8_t* hsv) const {
    return hue_[hsv[0]] & saturation_[hsv[1]] & value_[hsv[2]];
  }

 private:
  using Bits = std::array<std::uint64_t, 256>;
  static void add(Bits& bits, unsigned bit, const Range& range) {
    for (int i = std::max(range.first, 0); i <= std::min(range.last, 255); ++i) {
      bits[static_cast<std::size_t>(i)] |= std::uint64_t{1} << bit;
    }
  }
  Bits hue_{};
  Bits saturation_{};
  Bits value_{};
};

// A bit for each class of each window, and one for highlights.
constexpr std::size_t kWindowsAtOnce = 20;
constexpr unsigned kHighlight = 63;
enum ColorClass : unsigned { kSure, kPale, kFillable, kClasses };

int at_least(double share) { return static_cast<int>(std::lrint(255.0 * share)); }

/// A hue window that starts below 0° wraps around.
void add_window(ColorRanges& ranges, unsigned first_bit, const ColorWindow& window) {
  constexpr double kAnySaturation = 0.1;
  const int low = hue_byte(window.hue_low_deg);
  const int high = hue_byte(window.hue_high_deg);
  const double saturation[kClasses] = {window.min_saturation, window.min_saturation_at_fruit,
                                       kAnySaturation};
  for (unsigned c = 0; c < kClasses; ++c) {
    const ColorRanges::Range pale{at_least(saturation[c]), 255};
    const ColorRanges::Range bright{at_least(window.min_value), 255};
    ranges.add(first_bit + c, {low, high}, pale, bright);
    if (low < 0) ranges.add(first_bit + c, {256 + low, 256 + high}, pale, bright);
  }
}

ColorClasses classes_of(const cv::Mat& hsv, const ColorDetectorOptions& options) {
  constexpr double kGlaring = 0.9;
  const auto nothing = [&] { return cv::Mat(cv::Mat::zeros(hsv.rows, hsv.cols, CV_8U)); };
  ColorClasses classes{nothing(), nothing(), nothing()};
  std::uint64_t of_class[kClasses] = {};
  for (unsigned bit = 0; bit < kClasses * kWindowsAtOnce; ++bit) {
    of_class[bit % kClasses] |= std::uint64_t{1} << bit;
  }
  of_class[kFillable] |= std::uint64_t{1} << kHighlight;
  const auto& windows = options.windows;
  for (std::size_t first = 0; first < windows.size(); first += kWindowsAtOnce) {
    ColorRanges ranges;
    ranges.add(kHighlight, {}, {0, 120}, {at_least(kGlaring), 255});
    for (std::size_t i = first; i < std::min(first + kWindowsAtOnce, windows.size()); ++i) {
      add_window(ranges, static_cast<unsigned>(kClasses * (i - first)), windows[i]);
    }
    const std::uint8_t* pixel = hsv.ptr();
    const std::size_t count = hsv.total();
    for (std::size_t i = 0; i < count; ++i, pixel += 3) {
      const std::uint64_t in = ranges.of(pixel);
      if (in == 0) continue;
      if ((in & of_class[kSure]) != 0) classes.sure.data[i] = 255;
      if ((in & of_class[kPale]) != 0) classes.pale.data[i] = 255;
      if ((in & of_class[kFillable]) != 0) classes.fillable.data[i] = 255;
    }
  }
  return classes;
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

/// Surely fruit-coloured pixels, paler ones (highlights) that touch them, and holes.
cv::Mat fruit_colored(const cv::Mat& hsv, const ColorDetectorOptions& options) {
  const ColorClasses classes = classes_of(hsv, options);
  cv::Mat sure = classes.sure;
  if (options.opening_radius_px > 0) {
    cv::morphologyEx(sure, sure, cv::MORPH_OPEN, disc(options.opening_radius_px));
  }
  cv::Mat reach;
  constexpr int kSteps = 3;
  for (int step = 0; step < kSteps; ++step) {
    cv::dilate(sure, reach, disc(1));
    sure |= reach & classes.pale;
  }
  if (options.closing_radius_px > 0) {
    cv::Mat closed;
    cv::morphologyEx(sure, closed, cv::MORPH_CLOSE, disc(options.closing_radius_px));
    sure |= closed & classes.fillable;
  }
  return sure;
}

Mask to_mask(const cv::Mat& image) {
  Mask mask(image.cols, image.rows);
  std::copy_n(image.data, mask.pixels().size(), mask.pixels().begin());
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
  const cv::Mat in = classes_of(hsv_of(row), counting).sure;
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
  const Mask mask = to_mask(colored);
  const BlobLabels pieces = label_blobs(frame, mask, options_.depth_step_m);

  for_each_pixel_in(mask, [&](int u, int v) {
    const Blob& blob = pieces.blobs[static_cast<std::size_t>(pieces.label.at(u, v))];
    if (blob.pixels < options_.min_blob_px || blob.area_cm2 < options_.min_blob_area_cm2) return;
    const auto pixel = hsv.at<cv::Vec3b>(v, u);
    const ColorWindow& window = nearest_window(pixel[0], options_.windows);
    detection.label.at(u, v) = window.label;
    if (counted_fruit(window.label)) {
      detection.fruit.at(u, v) = static_cast<std::uint8_t>(window.label);
    }
    detection.confidence.at(u, v) = confidence_of(pixel[1], blob, window);
  });
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
