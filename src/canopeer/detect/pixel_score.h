#pragma once

#include "canopeer/sensing/image.h"

namespace canopeer {

/// How well a mask agrees with the true one, by pixels.
struct PixelScore {
  double precision = 1.0;  ///< true positives / found; 1 when nothing was found
  double recall = 1.0;     ///< true positives / true; 1 when there was nothing to find
  double iou = 1.0;        ///< intersection over union; 1 when both are empty
};

/// Running counts, so that a score can be taken over many images.
struct PixelCounts {
  long long true_positives = 0;
  long long false_positives = 0;
  long long false_negatives = 0;

  /// Adds one image; both masks have the same size. Pixels where `ignore` is non-zero do not count
  /// (null: all count).
  void add(const Mask& found, const Mask& truth, const Mask* ignore = nullptr);
  [[nodiscard]] PixelScore score() const;
};

}  // namespace canopeer
