#include "canopeer/base/simd_level.h"

namespace canopeer {

SimdLevel best_simd_level() {
#if defined(__x86_64__)
  static const SimdLevel best = [] {
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                      __builtin_cpu_supports("bmi2");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
      return SimdLevel::avx512;
    }
    return avx2 ? SimdLevel::avx2 : SimdLevel::narrow;
  }();
  return best;
#else
  return SimdLevel::narrow;
#endif
}

const char* simd_level_name(SimdLevel level) {
  switch (level) {
    case SimdLevel::avx512:
      return "avx512";
    case SimdLevel::avx2:
      return "avx2";
    case SimdLevel::narrow:
#if defined(__aarch64__)
      return "neon";
#else
      return "sse4.2";
#endif
    case SimdLevel::scalar:
      break;
  }
  return "scalar";
}

}  // namespace canopeer
