#include "canopeer/robot/kinematics/sin_cos.h"

#include <cstdint>
#include <cstring>

#include "canopeer/base/simd_vectors.h"

namespace canopeer {
namespace {

using Doubles = FourDoubles;
using Bits = std::int64_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline constexpr Doubles all(double value) {
  return Doubles{value, value, value, value};
}

[[gnu::always_inline]] inline Bits bits_of(Doubles x) {
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

[[gnu::always_inline]] inline Doubles doubles_of(Bits bits) {
  Doubles x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// On [−π/4, π/4]; z = r².
[[gnu::always_inline]] inline Doubles sine_polynomial(Doubles r, Doubles z) {
  const Doubles tail =
      all(8.33333333332248946124e-03) +
      z * (all(-1.98412698298579493134e-04) +
           z * (all(2.75573137070700676789e-06) +
                z * (all(-2.50507602534068634195e-08) + z * all(1.58969099521155010221e-10))));
  return r + z * r * (all(-1.66666666666666324348e-01) + z * tail);
}

[[gnu::always_inline]] inline Doubles cosine_polynomial(Doubles z) {
  const Doubles tail = all(4.16666666666666019037e-02) +
                       z * (all(-1.38888888888741095749e-03) +
                            z * (all(2.48015872894767294178e-05) +
                                 z * (all(-2.75573143513906633035e-07) +
                                      z * (all(2.08757232129817482790e-09) +
                                           z * all(-1.13596475577881948265e-11)))));
  const Doubles half = all(0.5) * z;
  const Doubles w = all(1.0) - half;
  return w + (((all(1.0) - w) - half) + z * z * tail);  // what 1 − z/2 rounds off is put back
}

[[gnu::always_inline]] inline void four(const double* angles, double* sines, double* cosines) {
  Doubles x;
  std::memcpy(&x, angles, sizeof x);
  // Adding 1.5 · 2⁵² rounds to a whole number, which then stands in the low bits.
  const Doubles magic = all(6755399441055744.0);
  const Doubles shifted = x * all(6.36619772367581382433e-01) + magic;
  const Doubles quadrant = shifted - magic;
  const Doubles r =
      (x - quadrant * all(1.57079632673412561417e+00)) - quadrant * all(6.07710050650619224932e-11);
  const Doubles z = r * r;
  const Bits s = bits_of(sine_polynomial(r, z));
  const Bits c = bits_of(cosine_polynomial(z));

  const Bits k = bits_of(shifted);
  const Bits odd = -(k & 1);  // all ones where sine and cosine change places
  const Bits sine_sign = (k & 2) << 62;
  const Bits cosine_sign = ((k + 1) & 2) << 62;
  const Doubles sine = doubles_of(((s & ~odd) | (c & odd)) ^ sine_sign);
  const Doubles cosine = doubles_of(((c & ~odd) | (s & odd)) ^ cosine_sign);
  std::memcpy(sines, &sine, sizeof sine);
  std::memcpy(cosines, &cosine, sizeof cosine);
}

// AVX2 only doubles the width; contraction to fused operations is off for all code, so the bits are
// those of the narrow version.
CANOPEER_WIDE void sin_cos_wide(const double* angles, int count, double* sines, double* cosines) {
  for (int i = 0; i < count; i += 4) four(angles + i, sines + i, cosines + i);
}

void sin_cos_narrow(const double* angles, int count, double* sines, double* cosines) {
  for (int i = 0; i < count; i += 4) four(angles + i, sines + i, cosines + i);
}

}  // namespace

void sin_cos(const double* angles, int count, double* sines, double* cosines) {
  (has_wide_registers() ? sin_cos_wide : sin_cos_narrow)(angles, count, sines, cosines);
}

}  // namespace canopeer
