#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/detect/detector.h"

namespace canopeer {

/// How far the labels of a frame are believed.
struct LabelDetectorOptions {
  /// A pixel is what most pixels of its window are, so that labels that are wrong here and there do
  /// no harm. Side 2 · radius + 1 pixels; 0: labels are taken as they are.
  int majority_radius_px = 0;
  double depth_step_m = 0.02;  ///< pixels farther in depth have no voice
  double confidence = 1.0;     ///< of a label, 0 … 1; times the share of voices for it

  [[nodiscard]] Expected<void> validate() const;
};

/// Takes the labels that come with the frame: the simulator's ground truth (with its label noise),
/// or those of a camera that labels pixels. A frame without labels is an error.
class LabelDetector final : public Detector {
 public:
  explicit LabelDetector(const LabelDetectorOptions& options = {});
  [[nodiscard]] Expected<Detection> detect(const RgbdFrame& frame) const override;

 private:
  LabelDetectorOptions options_;
};

}  // namespace canopeer
