#include "canopeer/report/drawing/axis_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

/// The smallest of 1, 2, 5, 10 times a power of ten that is not below `raw`.
double nice_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

std::string AxisTicks::label(double value) const {
  const std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool negative = value < 0.0 && text.find_first_not_of("0.") != std::string::npos;
  return negative ? "\u2212" + text : text;  // the minus sign, not a hyphen
}

AxisTicks axis_ticks(double low, double high, int target, bool whole) {
  AxisTicks ticks;
  if (!(high > low) || target < 1) {
    ticks.values.push_back(low);
    return ticks;
  }
  double step = nice_step((high - low) / target);
  if (whole) step = std::max(step, 1.0);
  ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double slack = 1e-9 * (high - low);
  for (double i = std::ceil((low - slack) / step); i * step <= high + slack; i += 1.0) {
    ticks.values.push_back(i * step);
  }
  return ticks;
}

}  // namespace canopeer
