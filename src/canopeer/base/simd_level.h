#pragma once

namespace canopeer {

/// Instruction sets that kernels are compiled for, one body each. A level changes the speed, never
/// a bit of the result. avx2 includes BMI1 and BMI2, as all processors with AVX2 have them. avx512
/// is that with F, BW, DQ and VL.
enum class SimdLevel { scalar, avx2, avx512 };

inline constexpr SimdLevel kSimdLevels[] = {SimdLevel::scalar, SimdLevel::avx2, SimdLevel::avx512};

/// The best level this machine has.
SimdLevel best_simd_level();

const char* simd_level_name(SimdLevel level);

}  // namespace canopeer

/// Of NAME_scalar, NAME_avx2 and NAME_avx512 the one of a level; elsewhere there is the first only.
#if defined(__x86_64__)
#define CANOPEER_AT_LEVEL(level, NAME)                      \
  ((level) == ::canopeer::SimdLevel::avx512 ? NAME##_avx512 \
   : (level) == ::canopeer::SimdLevel::avx2 ? NAME##_avx2   \
                                            : NAME##_scalar)
#else
#define CANOPEER_AT_LEVEL(level, NAME) NAME##_scalar
#endif
