#pragma once

#include <cstdint>

#include "canopeer/base/simd_vectors.h"

namespace canopeer {

// Logarithm and exponential of four doubles at once: the rational approximations of the Cephes
// library (Moshier 1992). Operations and their order are those of Eigen's arrays, so the bits are
// theirs too, with and without wide registers. Errors are below 2 units in the last place.

using FourLongs = std::int64_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline FourLongs bits_of(const FourDoubles& x) {
  return load_lanes<FourLongs>(&x);
}
[[gnu::always_inline]] inline FourDoubles doubles_of(const FourLongs& bits) {
  return load_lanes<FourDoubles>(&bits);
}

/// `x`: positive, finite and normal (2.3e-308 at least).
[[gnu::always_inline]] inline FourDoubles log_of(const FourDoubles& x) {
  constexpr double kHalfRoot = 0.70710678118654752440;  // √½
  constexpr double kLn2 = 0.693147180559945309417;
  // x = m 2^e, m in [½, 1). Whole numbers stand in the low bits of 2⁵² + 2⁵¹ + number.
  constexpr double kMagic = 6755399441055744.0;
  const FourLongs bits = bits_of(x);
  const FourLongs exponent = ((bits >> 52) & 0x7FF) - 1022;
  FourDoubles e = doubles_of(exponent + bits_of(all_lanes<FourDoubles>(kMagic))) - kMagic;
  FourDoubles m = doubles_of((bits & 0x000FFFFFFFFFFFFF) | 0x3FE0000000000000);
  // To [√½, √2), less 1.
  const FourLongs low = m < kHalfRoot;
  const FourDoubles again = doubles_of(bits_of(m) & low);
  m = m - 1.0;
  e = e - doubles_of(bits_of(all_lanes<FourDoubles>(1.0)) & low);
  m = m + again;

  const FourDoubles m2 = m * m;
  const FourDoubles m3 = m2 * m;
  FourDoubles p = 1.01875663804580931796e-4 * m + 4.97494994976747001425e-1;
  FourDoubles p_low = 1.44989225341610930846e1 * m + 1.79368678507819816313e1;
  p = p * m + 4.70579119878881725854;
  p_low = p_low * m + 7.70838733755885391666;
  p = p * m3 + p_low;
  FourDoubles q = m + 1.12873587189167450590e1;
  FourDoubles q_low = 8.29875266912776603211e1 * m + 7.11544750618563894466e1;
  q = q * m + 4.52279145837532221105e1;
  q_low = q_low * m + 2.31251620126765340583e1;
  q = q * m3 + q_low;
  const FourDoubles y = p * m3 / q;
  return e * kLn2 + (m + (-0.5 * m2 + y));
}

/// `x`: no NaN; taken as ± 708 beyond, so that the result is positive, finite and normal.
[[gnu::always_inline]] inline FourDoubles exp_of(const FourDoubles& given) {
  constexpr double kMost = 708.0;
  constexpr double kMagic = 6755399441055744.0;
  FourDoubles x = given < kMost ? given : all_lanes<FourDoubles>(kMost);
  x = x > -kMost ? x : all_lanes<FourDoubles>(-kMost);
  // x = n log 2 + g, |g| ≤ ½ log 2; log 2 in two parts, so that g keeps its digits.
  const FourDoubles over = 1.4426950408889634073599 * x + 0.5;
  FourDoubles n = (over + kMagic) - kMagic;
  n = n - doubles_of(bits_of(all_lanes<FourDoubles>(1.0)) & (n > over));
  const FourDoubles g = (x - n * 0.693145751953125) - n * 1.42860682030941723212e-6;
  const FourDoubles g2 = g * g;
  FourDoubles p = 1.26177193074810590878e-4 * g2 + 3.02994407707441961300e-2;
  p = p * g2 + 9.99999999999999999910e-1;
  p = p * g;
  FourDoubles q = 3.00198505138664455042e-6 * g2 + 2.52448340349684104192e-3;
  q = q * g2 + 2.27265548208155028766e-1;
  q = q * g2 + 2.00000000000000000009;
  const FourDoubles y = 2.0 * (p / (q - p)) + 1.0;
  const FourLongs power = (bits_of(n + kMagic) + 1023) << 52;  // 2ⁿ
  return y * doubles_of(power);
}

}  // namespace canopeer
