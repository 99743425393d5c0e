#include "canopeer/render/motion/shutter.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

Shutter::Shutter(const CameraMotionOptions& motion, int rows, int count)
    : exposure_s_(motion.exposure_s),
      readout_s_(motion.readout_s),
      depth_readout_s_(motion.depth_rolls ? motion.readout_s : 0.0),
      rows_(rows),
      count_(count) {}

double Shutter::time_s(int i) const {
  return ((i + 0.5) / count_ - 0.5) * (exposure_s_ + readout_s_);
}

RowExposure Shutter::row(int v, double readout_s) const {
  RowExposure row;
  const double whole = exposure_s_ + readout_s_;
  if (count_ == 1 || whole <= 0.0) {
    row.shares = {RowExposure::kWhole};
    return row;
  }
  const double slice = whole / count_;
  const double middle = (rows_ > 1 ? v / (rows_ - 1.0) - 0.5 : 0.0) * readout_s + whole / 2.0;
  const double begin = middle - exposure_s_ / 2.0;
  const auto slice_at = [&](double t) {
    return std::clamp(static_cast<int>(std::floor(t / slice)), 0, count_ - 1);
  };
  row.middle = slice_at(middle);
  if (exposure_s_ <= 0.0) {
    row.first = row.middle;
    row.shares = {RowExposure::kWhole};
    return row;
  }
  row.first = slice_at(begin);
  // Shares are differences of what has been seen up to the end of each slice: they sum to a whole.
  std::uint32_t seen = 0;
  for (int i = row.first; seen < RowExposure::kWhole; ++i) {
    const double part = i + 1 < count_ ? ((i + 1) * slice - begin) / exposure_s_ : 1.0;
    const auto until =
        static_cast<std::uint32_t>(std::lround(std::clamp(part, 0.0, 1.0) * RowExposure::kWhole));
    row.shares.push_back(until - seen);
    seen = until;
  }
  return row;
}

int sub_frames_for(double motion_px, int most) {
  if (motion_px < 0.5 || most < 3) return 1;
  const double pairs = std::max(1.0, std::ceil((motion_px - 1.0) / 2.0));
  return 1 + 2 * static_cast<int>(std::min(pairs, std::floor((most - 1) / 2.0)));
}

}  // namespace canopeer
