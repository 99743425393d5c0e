#include "canopeer/geometry/superellipsoid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

Superellipsoid random_body(Rng& rng) {
  Superellipsoid body;
  body.semi_axes_m = {rng.uniform(0.02, 0.08), rng.uniform(0.02, 0.08), rng.uniform(0.02, 0.08)};
  body.e1 = rng.uniform(0.3, 1.2);
  body.e2 = rng.uniform(0.3, 1.2);
  body.T_world_body.linear() =
      rotation_of({rng.uniform(-3, 3), rng.uniform(-1.5, 1.5), rng.uniform(-3, 3)});
  body.T_world_body.translation() =
      Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
  return body;
}

/// F of the definition, written out.
double definition(const Superellipsoid& b, const Vec3& p) {
  const Vec3 q = b.T_world_body.inverse() * p;
  const Vec3 s = q.cwiseAbs().cwiseQuotient(b.semi_axes_m);
  return std::pow(std::pow(s.x(), 2 / b.e2) + std::pow(s.y(), 2 / b.e2), b.e2 / b.e1) +
         std::pow(s.z(), 2 / b.e1);
}

TEST(Superellipsoid, GaugeIsThePowerOfTheDefinition) {
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const Superellipsoid body = random_body(rng);
    const Vec3 p = body.centre() + 0.1 * Vec3{rng.normal(), rng.normal(), rng.normal()};
    EXPECT_NEAR(body.gauge(p), std::pow(definition(body, p), body.e1 / 2), 1e-9 * body.gauge(p));
  }
}

TEST(Superellipsoid, RadialDistanceReachesTheSurfaceAlongTheRay) {
  Rng rng(2);
  for (int i = 0; i < 500; ++i) {
    const Superellipsoid body = random_body(rng);
    const Vec3 direction = Vec3{rng.normal(), rng.normal(), rng.normal()}.normalized();
    const Vec3 p = body.centre() + rng.uniform(0.005, 0.2) * direction;
    const Vec3 on_surface = p - body.radial_distance(p) * direction;
    EXPECT_NEAR(definition(body, on_surface), 1.0, 1e-6);
  }
}

TEST(Superellipsoid, VolumeAgreesWithMonteCarlo) {
  Rng rng(3);
  for (int i = 0; i < 12; ++i) {
    Superellipsoid body = random_body(rng);
    body.T_world_body = Pose::Identity();
    constexpr int kSamples = 100000;
    int inside = 0;
    for (int k = 0; k < kSamples; ++k) {
      const Vec3 p = Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}.cwiseProduct(
          body.semi_axes_m);
      inside += definition(body, p) < 1.0;
    }
    const double box = 8.0 * body.semi_axes_m.prod();
    const double share = static_cast<double>(inside) / kSamples;
    const double sd = box * std::sqrt(share * (1.0 - share) / kSamples);
    EXPECT_NEAR(body.volume_m3(), box * share, 4.0 * sd) << "e1 " << body.e1 << " e2 " << body.e2;
  }
}

TEST(Superellipsoid, VolumeOfAnEllipsoidIsTheClosedForm) {
  Superellipsoid body;
  body.semi_axes_m = {0.02, 0.03, 0.04};
  EXPECT_NEAR(body.volume_m3(), 4.0 / 3.0 * std::numbers::pi * 0.02 * 0.03 * 0.04, 1e-15);
}

TEST(Superellipsoid, SamplesLieOnTheSurfaceWithNormalsSquareToIt) {
  Rng rng(4);
  for (int i = 0; i < 20; ++i) {
    const Superellipsoid body = random_body(rng);
    for (const SurfacePoint& s : body.surface_samples(200)) {
      EXPECT_NEAR(body.gauge(s.point), 1.0, 1e-9);
      EXPECT_NEAR(s.normal.norm(), 1.0, 1e-9);
      // The gauge grows fastest along the normal, not at all across it.
      const Vec3 across = s.normal.unitOrthogonal();
      const auto slope = [&](const Vec3& d) {
        return (body.gauge(s.point + 1e-6 * d) - body.gauge(s.point - 1e-6 * d)) / 2e-6;
      };
      EXPECT_GT(slope(s.normal), 5.0);
      EXPECT_LT(std::abs(slope(across)), 2e-3 * slope(s.normal) + 0.05);
    }
  }
}

TEST(Superellipsoid, AnglesAndRotationsGoBackAndForth) {
  Rng rng(5);
  for (int i = 0; i < 100; ++i) {
    const Vec3 angles{rng.uniform(-3.1, 3.1), rng.uniform(-1.5, 1.5), rng.uniform(-3.1, 3.1)};
    EXPECT_LT((roll_pitch_yaw_of(rotation_of(angles)) - angles).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace canopeer
