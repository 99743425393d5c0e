#pragma once

namespace canopeer {

/// Instruction sets that kernels are compiled for, one body each. A level changes the speed, never
/// a bit of the result. narrow: registers of 16 bytes, which every machine has (SSE 4.2, NEON).
/// avx2 includes BMI1 and BMI2, as all processors with AVX2 have them. avx512 is that with F, BW,
/// DQ and VL.
enum class SimdLevel { scalar, narrow, avx2, avx512 };

inline constexpr SimdLevel kSimdLevels[] = {SimdLevel::scalar, SimdLevel::narrow, SimdLevel::avx2,
                                            SimdLevel::avx512};

/// The best level this machine has.
SimdLevel best_simd_level();

const char* simd_level_name(SimdLevel level);

}  // namespace canopeer

/// Of NAME_scalar, NAME_avx2 and NAME_avx512 the one of a level; elsewhere than on x86-64 there is
/// the first only. It is the narrow one, too: the compiler makes vectors of its loops.
#if defined(__x86_64__)
#define CANOPEER_AT_LEVEL(level, NAME)                      \
  ((level) == ::canopeer::SimdLevel::avx512 ? NAME##_avx512 \
   : (level) == ::canopeer::SimdLevel::avx2 ? NAME##_avx2   \
                                            : NAME##_scalar)
#else
#define CANOPEER_AT_LEVEL(level, NAME) NAME##_scalar
#endif

/// The same where the narrow one is written out, since the compiler leaves the scalar loop as it
/// is.
#define CANOPEER_AT_EACH_LEVEL(level, NAME) \
  ((level) == ::canopeer::SimdLevel::narrow ? NAME##_narrow : CANOPEER_AT_LEVEL(level, NAME))
