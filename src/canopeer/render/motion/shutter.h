#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/render/camera_motion.h"

namespace canopeer {

/// What a row of pixels sees of the sub-frames.
struct RowExposure {
  static constexpr std::uint32_t kWhole = 65536;

  int middle = 0;  ///< the sub-frame in the middle of its exposure
  int first = 0;   ///< the first one it sees
  std::vector<std::uint32_t>
      shares;  ///< of its exposure: of `first` and those after it; sum kWhole

  [[nodiscard]] int last() const { return first + static_cast<int>(shares.size()) - 1; }
};

/// When the sub-frames of a frame are taken, and which row sees which. They stand for equal slices
/// of the time from the first row's first light to the last row's last; the middle one lies in the
/// middle of the frame.
class Shutter {
 public:
  /// `count` is odd: sub_frames_for().
  Shutter(const CameraMotionOptions& motion, int rows, int count);

  [[nodiscard]] int count() const { return count_; }
  /// The middle of sub-frame `i`, s, from the middle of the frame on.
  [[nodiscard]] double time_s(int i) const;
  /// What row `v` sees in colour and labels, and in depth.
  [[nodiscard]] RowExposure color_row(int v) const { return row(v, readout_s_); }
  [[nodiscard]] RowExposure depth_row(int v) const { return row(v, depth_readout_s_); }

 private:
  [[nodiscard]] RowExposure row(int v, double readout_s) const;

  double exposure_s_;
  double readout_s_;
  double depth_readout_s_;
  int rows_;
  int count_;
};

/// How many sub-frames an image needs that moves by so many pixels: one below half a pixel, else
/// the least odd number, 3 at least, that keeps them within a pixel of each other; no more than
/// `most`.
[[nodiscard]] int sub_frames_for(double motion_px, int most);

}  // namespace canopeer
