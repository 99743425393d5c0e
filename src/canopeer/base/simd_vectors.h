#pragma once

#include <cstdint>
#include <cstring>

#include "canopeer/base/simd_level.h"

#if defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace canopeer {

// Numbers that are reckoned with at once: vectors of the compiler (GCC, Clang), so that choices
// need no branches. A vector wider than the machine's registers is held in several: the same
// operations, and without fused multiply-add, so the same bits. Functions over them are inlined
// into what calls them, so that each caller's instruction set decides.

using FourFloats = float __attribute__((vector_size(16)));
using EightFloats = float __attribute__((vector_size(32)));
using FourDoubles = double __attribute__((vector_size(32)));
/// What comparing floats gives: all bits of a lane set or none.
using FourBits = std::int32_t __attribute__((vector_size(16)));
using EightBits = std::int32_t __attribute__((vector_size(32)));

template <typename Vector, typename Scalar>
[[gnu::always_inline]] inline Vector load_lanes(const Scalar* from) {
  Vector lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

template <typename Vector, typename Scalar>
[[gnu::always_inline]] inline void store_lanes(const Vector& lanes, Scalar* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

/// Every lane the same value.
template <typename Vector, typename Scalar>
[[gnu::always_inline]] inline Vector all_lanes(Scalar value) {
  return value - Vector{};
}

/// The first lanes of a vector of eight, and the others; and together again.
[[gnu::always_inline]] inline FourFloats low_half(const EightFloats& lanes) {
  return __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline FourFloats high_half(const EightFloats& lanes) {
  return __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline EightFloats joined(const FourFloats& low, const FourFloats& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Bit i: lane i of a comparison holds.
[[gnu::always_inline]] inline unsigned lane_bits(const FourBits& lanes) {
#if defined(__SSE__)
  FourFloats bits;
  std::memcpy(&bits, &lanes, sizeof bits);
  return static_cast<unsigned>(__builtin_ia32_movmskps(bits));
#elif defined(__ARM_NEON)
  return static_cast<unsigned>(vaddvq_s32(lanes & FourBits{1, 2, 4, 8}));
#else
  const FourBits set = lanes & FourBits{1, 2, 4, 8};
  return static_cast<unsigned>(set[0] | set[1] | set[2] | set[3]);
#endif
}
[[gnu::always_inline]] inline unsigned lane_bits(const EightBits& lanes) {
  return lane_bits(__builtin_shufflevector(lanes, lanes, 0, 1, 2, 3)) |
         lane_bits(__builtin_shufflevector(lanes, lanes, 4, 5, 6, 7)) << 4U;
}

/// Marks the twin of a function that is compiled for registers of 32 bytes, where there are such.
#if defined(__x86_64__)
#define CANOPEER_WIDE [[gnu::target("avx2")]]
#else
#define CANOPEER_WIDE
#endif

/// This machine has registers of 32 bytes.
inline bool has_wide_registers() {
  static const bool has = best_simd_level() >= SimdLevel::avx2;
  return has;
}

}  // namespace canopeer
