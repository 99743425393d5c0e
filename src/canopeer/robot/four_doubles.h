#pragma once

#include <cstring>

#include "canopeer/base/simd_level.h"

namespace canopeer {

/// Four doubles at once, in one register where there are such, else in two: the same operations
/// without fused multiply-add, so the same bits.
using FourDoubles = double __attribute__((vector_size(32)));

[[gnu::always_inline]] inline FourDoubles load_four(const double* from) {
  FourDoubles four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

[[gnu::always_inline]] inline void store_four(double* to, FourDoubles four) {
  std::memcpy(to, &four, sizeof four);
}

/// This machine has registers of four doubles.
inline bool has_wide_registers() {
  static const bool has = best_simd_level() != SimdLevel::scalar;
  return has;
}

}  // namespace canopeer
