#pragma once

namespace canopeer {

/// Sines and cosines of `count` angles (rad, |angle| ≤ 1e5) at once, four per step in vector
/// registers. Within 1.5 units in the last place. The same bits on every machine, which the C
/// library's sin() does not promise: wider registers are used where there are any, for the same
/// operations. `angles`, `sines` and `cosines` must have room for a multiple of four values. What
/// stands in the angles beyond `count` does not matter.
///
/// Argument reduction by π/2 in two parts and the polynomials of fdlibm (Sun Microsystems 1993,
/// k_sin.c and k_cos.c).
void sin_cos(const double* angles, int count, double* sines, double* cosines);

}  // namespace canopeer
