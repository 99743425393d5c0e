#pragma once

#include <string>
#include <vector>

namespace canopeer {

/// Where an axis is labelled: multiples of 1, 2 or 5 times a power of ten, inside the range.
struct AxisTicks {
  std::vector<double> values;
  int decimals = 0;  ///< that tell neighbouring ticks apart

  [[nodiscard]] std::string label(double value) const;
};

/// At most about `target` ticks in [low, high]; `whole` keeps the step at 1 or more (counts).
[[nodiscard]] AxisTicks axis_ticks(double low, double high, int target, bool whole = false);

}  // namespace canopeer
