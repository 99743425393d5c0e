#include "canopeer/base/simd_level.h"

#include <gtest/gtest.h>

#include <string>

namespace canopeer {
namespace {

TEST(SimdLevel, EveryMachineHasVectors) {
  EXPECT_GE(best_simd_level(), SimdLevel::narrow);
#if defined(__aarch64__)
  EXPECT_EQ(simd_level_name(best_simd_level()), std::string("neon"));
#endif
}

}  // namespace
}  // namespace canopeer
