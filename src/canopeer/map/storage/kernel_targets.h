#pragma once

#include <cstddef>

#include "canopeer/base/simd_level.h"

// A kernel is one body, written as plain loops and inlined into one function per instruction set.
// The compiler turns the loops into that set's vectors. Nothing is summed in another order and no
// multiply-add is fused, so all of them give the same bits.

#define CANOPEER_KERNEL_BODY [[gnu::always_inline]] inline
#if defined(__x86_64__)
#define CANOPEER_TARGET_AVX2 __attribute__((target("avx2")))
#define CANOPEER_TARGET_BMI2 __attribute__((target("bmi,bmi2")))  // from level avx2 on
#if defined(__clang__)
#define CANOPEER_TARGET_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
#else
#define CANOPEER_TARGET_AVX512 \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
// KERNELS(NAME, TARGET) for each level there is.
#define CANOPEER_EACH_LEVEL(KERNELS)  \
  KERNELS(scalar, )                   \
  KERNELS(avx2, CANOPEER_TARGET_AVX2) \
  KERNELS(avx512, CANOPEER_TARGET_AVX512)
#else
#define CANOPEER_TARGET_AVX2
#define CANOPEER_TARGET_BMI2
#define CANOPEER_TARGET_AVX512
#define CANOPEER_EACH_LEVEL(KERNELS) KERNELS(scalar, )
#endif
