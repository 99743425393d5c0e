#include "canopeer/fruit/shapes/shape_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

/// Points of a spheroid whose normals are within `max_angle` of `towards`, with noise.
std::vector<SurfacePoint> cap(const ShapeEstimate& body, const Vec3& towards, double max_angle,
                              double noise_m, Rng& rng) {
  std::vector<SurfacePoint> points;
  const Vec3 axes(body.radius_m, body.radius_m, body.half_length_m);
  while (points.size() < 200) {
    const double z = rng.uniform(-1.0, 1.0);
    const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 u(r * std::cos(angle), r * std::sin(angle), z);
    const Vec3 normal = u.cwiseQuotient(axes).normalized();
    if (normal.dot(towards) < std::cos(max_angle)) continue;
    points.push_back(
        {body.centre + u.cwiseProduct(axes) + rng.normal(0.0, noise_m) * normal, normal});
  }
  return points;
}

TEST(ShapeEstimate, RecoversAWholeSpheroid) {
  Rng rng(1);
  const ShapeEstimate truth{{0.1, -2.0, 0.7}, 0.035, 0.042, 0.0};
  const ShapeEstimate found =
      estimate_shape(cap(truth, Vec3::UnitX(), std::numbers::pi, 0.001, rng));
  EXPECT_LT((found.centre - truth.centre).norm(), 0.001);
  EXPECT_NEAR(found.radius_m, truth.radius_m, 0.001);
  EXPECT_NEAR(found.half_length_m, truth.half_length_m, 0.001);
  EXPECT_NEAR(found.volume_cm3(), truth.volume_cm3(), 0.05 * truth.volume_cm3());
}

TEST(ShapeEstimate, ErrsByLessThanTwoCentimetresOnSmallNoisyCaps) {
  Rng rng(2);
  for (int i = 0; i < 40; ++i) {
    const ShapeEstimate truth{
        {0.0, 0.0, 0.5}, rng.uniform(0.024, 0.042), rng.uniform(0.030, 0.048), 0.0};
    const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec3 towards = Vec3(std::cos(angle), std::sin(angle), 0.3).normalized();
    const ShapeEstimate found = estimate_shape(cap(truth, towards, 0.5, 0.002, rng));
    EXPECT_LT((found.centre - truth.centre).norm(), 0.02) << "cap " << i;
  }
}

TEST(ShapeEstimate, RadialDistanceIsZeroOnTheSurfaceAndNegativeInside) {
  const ShapeEstimate body{{1, 2, 3}, 0.03, 0.04, 0.0};
  EXPECT_NEAR(body.radial_distance(Vec3(1.03, 2, 3)), 0.0, 1e-12);
  EXPECT_NEAR(body.radial_distance(Vec3(1, 2, 3.05)), 0.01, 1e-12);
  EXPECT_LT(body.radial_distance(Vec3(1, 2, 3)), 0.0);
}

TEST(CentreVote, OfEverySurfacePointIsTheCentre) {
  Rng rng(3);
  const ShapeEstimate body{{1, 2, 3}, 0.03, 0.04, 0.0};
  for (const SurfacePoint& s : cap(body, Vec3::UnitZ(), std::numbers::pi, 0.0, rng)) {
    EXPECT_LT((centre_vote(s, 0.03, 0.04) - body.centre).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace canopeer
