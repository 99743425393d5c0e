#pragma once

#include <cstdint>
#include <cstring>

namespace canopeer {

/// Four floats that are reckoned with at once, and what comparing them gives: all bits of a lane
/// set or none. Vectors of the compiler (GCC, Clang), so that choices need no branches.
using Four = float __attribute__((vector_size(16)));
using FourBits = std::int32_t __attribute__((vector_size(16)));

inline Four all(float value) { return Four{value, value, value, value}; }

inline Four load_four(const float* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

inline void store_four(const Four& four, float* to) { std::memcpy(to, &four, sizeof four); }

/// Bit i: lane i of a comparison holds.
inline unsigned bits(const FourBits& lanes) {
  const FourBits set = lanes & FourBits{1, 2, 4, 8};
  return static_cast<unsigned>(set[0] | set[1] | set[2] | set[3]);
}

}  // namespace canopeer
