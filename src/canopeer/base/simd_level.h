#pragma once

namespace canopeer {

/// Instruction sets that kernels are compiled for, one body each. A level changes the speed,
/// never a bit of the result. avx512 is F, BW, DQ and VL.
enum class SimdLevel { scalar, avx2, avx512 };

inline constexpr SimdLevel kSimdLevels[] = {SimdLevel::scalar, SimdLevel::avx2, SimdLevel::avx512};

/// The best level this machine has.
SimdLevel best_simd_level();

const char* simd_level_name(SimdLevel level);

}  // namespace canopeer
