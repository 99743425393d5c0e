#pragma once

#include <span>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/detect/detector.h"

namespace canopeer {

/// The colours of one ripeness: a pixel has one when its hue lies in the window and it is saturated
/// and bright enough.
struct ColorWindow {
  PixelLabel label = PixelLabel::ripe_fruit;
  double hue_low_deg = -14.0;  ///< red is 0°; in [−180, hue_high_deg]
  double hue_high_deg = 14.5;
  double min_saturation = 0.78;  ///< HSV, 0 … 1; dry leaves and clay are paler
  double min_value = 0.16;       ///< HSV, 0 … 1; below it hue is noise
  /// Highlights whiten: pixels this pale are taken back when they touch surely fruit-coloured ones.
  double min_saturation_at_fruit = 0.50;
};

/// Blobs of such pixels are cleaned by morphology and judged by their size in the world.
struct ColorDetectorOptions {
  /// Turning fruits are orange (19°). Green ones start at 50°, where leaves are too.
  std::vector<ColorWindow> windows = {{},
                                      {PixelLabel::turning_fruit, 14.5, 29.0, 0.78, 0.16, 0.50}};
  int opening_radius_px = 1;       ///< removes threads and specks; 0: off
  int closing_radius_px = 2;       ///< closes pinholes; 0: off
  int min_blob_px = 12;            ///< smaller blobs are dropped
  double min_blob_area_cm2 = 0.5;  ///< the same by size in the world: Σ (depth / f)²
  double depth_step_m = 0.02;      ///< neighbouring pixels farther apart are different blobs

  [[nodiscard]] Expected<void> validate() const;
};

/// Whether each colour lies in a window of fruits that count, as one pixel by itself.
[[nodiscard]] std::vector<bool> in_color_windows(std::span<const Rgb> colors,
                                                 const ColorDetectorOptions& options);

/// Fruit by colour (hue window, saturation and value floor; Marangoz et al., CASE 2022, in
/// simulation), with morphology and a size floor. Where windows overlap the nearer middle hue
/// decides. Frames whose colour and depth images differ in size are our bug.
class ColorDetector final : public Detector {
 public:
  explicit ColorDetector(const ColorDetectorOptions& options = {});
  [[nodiscard]] Expected<Detection> detect(const RgbdFrame& frame) const override;

 private:
  ColorDetectorOptions options_;
};

}  // namespace canopeer
