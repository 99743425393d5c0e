#pragma once

// Vectors of single precision for kernels that are compiled once per instruction set: as wide as
// the including file's compile options allow. Lanes do not meet, nothing is fused or approximated:
// every width gives the same bits. All is local to the including file, so that no function compiled
// for wider vectors can take another's place.

#include <cstddef>
#include <cstdint>

#if defined(__SSE4_1__)
#include <immintrin.h>
#elif defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace canopeer {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif

using Floats = float __attribute__((vector_size(4 * kLanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Words = std::uint32_t __attribute__((vector_size(4 * kLanes)));

[[maybe_unused]] Floats load(const float* from) {
  Floats v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
[[maybe_unused]] void store(Floats v, float* to) { __builtin_memcpy(to, &v, sizeof v); }
[[maybe_unused]] Floats all(float x) { return x - Floats{}; }
[[maybe_unused]] Floats least(Floats a, Floats b) { return a < b ? a : b; }
[[maybe_unused]] Floats most(Floats a, Floats b) { return a > b ? a : b; }

[[maybe_unused]] Floats root(Floats x) {
#if defined(__AVX512F__)
  return _mm512_sqrt_ps(x);
#elif defined(__AVX2__)
  return _mm256_sqrt_ps(x);
#elif defined(__SSE4_1__)
  return _mm_sqrt_ps(x);
#elif defined(__ARM_NEON)
  return vsqrtq_f32(x);
#else
  for (int i = 0; i < kLanes; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
#endif
}

[[maybe_unused]] Floats floor_of(Floats x) {
#if defined(__AVX512F__)
  return _mm512_floor_ps(x);
#elif defined(__AVX2__)
  return _mm256_floor_ps(x);
#elif defined(__SSE4_1__)
  return _mm_floor_ps(x);
#elif defined(__ARM_NEON)
  return vrndmq_f32(x);
#else
  for (int i = 0; i < kLanes; ++i) x[i] = __builtin_floorf(x[i]);
  return x;
#endif
}

}  // namespace
}  // namespace canopeer
