#pragma once

#include <algorithm>
#include <cmath>

namespace canopeer {

/// √(x² + y²), good to one unit in the last place (Borges, "Algorithm 1014: An Improved Algorithm
/// for hypot(x, y)", 2020, without fused multiply-add). std::hypot of the C library fuses where the
/// machine can, and has other last digits there; on x86-64 these are its bits.
/// `x`, `y`: zero, or of a size between 1e-130 and 1e150.
inline double hypotenuse(double x, double y) {
  const double a = std::max(std::abs(x), std::abs(y));
  const double b = std::min(std::abs(x), std::abs(y));
  if (b <= a * 0x1p-54) return a + b;
  const double h = std::sqrt(a * a + b * b);
  double excess;  // h² − a² − b²
  if (h <= 2.0 * b) {
    const double d = h - b;
    excess = a * (2.0 * d - a) + (d - 2.0 * (a - b)) * d;
  } else {
    const double d = h - a;
    excess = 2.0 * d * (a - 2.0 * b) + ((4.0 * d - b) * b + d * d);
  }
  return h - excess / (2.0 * h);
}

}  // namespace canopeer
