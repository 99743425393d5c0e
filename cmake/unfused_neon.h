// Included before everything else on arm64. Eigen multiplies and adds in one rounding where the
// compiler says that the machine can, and x86-64's runs do not (decision 15). The compiler says so
// again at the end of arm_neon.h (GCC 14), which therefore has to be read before the word is taken
// back.
#include <arm_neon.h>
#undef __ARM_FEATURE_FMA
