#include <gtest/gtest.h>

#include "canopeer/base/rng.h"
#include "canopeer/geometry/pose.h"

namespace canopeer {
namespace {

/// With every product and every sum rounded, as on x86-64 without fused instructions (decision 15).
double rounded_product(const Eigen::Matrix3d& a, int row, const Vec3& b) {
  volatile double sum = a(row, 0) * b[0];
  for (int k = 1; k < 3; ++k) {
    const volatile double product = a(row, k) * b[k];
    sum = sum + product;
  }
  return sum;
}

TEST(Rounding, ProductsOfMatricesAreNotFused) {
  Rng rng(1);
  const auto number = [&] { return rng.uniform(-1.0, 1.0); };
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d a = Eigen::Matrix3d::NullaryExpr(number);
    const Vec3 b = Vec3::NullaryExpr(number);
    const Vec3 product = a * b;
    // Two rows at a time; the third is summed in another order.
    for (int row = 0; row < 2; ++row) EXPECT_EQ(product[row], rounded_product(a, row, b));
  }
}

}  // namespace
}  // namespace canopeer
