#include "canopeer/fruit/cloud_fruits.h"

#include <gtest/gtest.h>

#include <limits>

#include "canopeer/base/rng.h"
#include "canopeer/fruit/surface/cloud_normals.h"

namespace canopeer {
namespace {

Superellipsoid pepper(const Vec3& centre) {
  Superellipsoid body;
  body.semi_axes_m = {0.033, 0.031, 0.038};
  body.e1 = body.e2 = 0.75;
  body.T_world_body.translation() = centre;
  return body;
}

/// Two fruits that touch, a third apart; a millimetre of noise.
PointCloud three_fruits(bool normals) {
  Rng rng(1);
  PointCloud cloud;
  for (const Vec3& centre : {Vec3(0, 0, 1), Vec3(0, 0.066, 1), Vec3(0.3, 0, 1.2)}) {
    const Superellipsoid body = pepper(centre);
    for (const SurfacePoint& s : body.surface_samples(2500)) {
      cloud.points.push_back((s.point + rng.normal(0.0, 0.0005) * s.normal).cast<float>());
      if (normals) cloud.normals.push_back(s.normal.cast<float>());
      cloud.colors.push_back({200, 40, 10});
    }
  }
  return cloud;
}

std::string message_for(const PointCloud& cloud) {
  const auto fitted = fit_cloud(cloud);
  EXPECT_FALSE(fitted.has_value());
  return fitted ? std::string() : fitted.error().message;
}

TEST(FitCloud, FindsTheFruitsWithAndWithoutNormals) {
  for (const bool normals : {true, false}) {
    const auto fitted = fit_cloud(three_fruits(normals));
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    ASSERT_EQ(fitted->fruits.size(), 3U) << "normals " << normals;
    for (const Vec3& centre : {Vec3(0, 0, 1), Vec3(0, 0.066, 1), Vec3(0.3, 0, 1.2)}) {
      double nearest = 1.0;
      for (const FruitEstimate& f : fitted->fruits) {
        if ((f.centre - centre).norm() > nearest) continue;
        nearest = (f.centre - centre).norm();
        EXPECT_NEAR(f.volume_cm3 / (1e6 * pepper(centre).volume_m3()), 1.0, 0.1);
        EXPECT_GT(f.seen_share, 0.85);
        EXPECT_EQ(f.color.r, 200);
      }
      EXPECT_LT(nearest, 0.004) << "normals " << normals;
    }
  }
}

TEST(FitCloud, LeavesOutPointsThatAreNotFinite) {
  PointCloud cloud = three_fruits(true);
  for (std::size_t i = 0; i < cloud.points.size(); i += 7) {
    cloud.points[i].x() = std::numeric_limits<float>::quiet_NaN();
  }
  const auto fitted = fit_cloud(cloud);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_EQ(fitted->fruits.size(), 3U);
}

TEST(FitCloud, SaysWhyThereIsNothingToFit) {
  EXPECT_NE(message_for({}).find("empty"), std::string::npos);
  PointCloud nan;
  nan.points.assign(100, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_NE(message_for(nan).find("none of the 100 points is finite"), std::string::npos);
  PointCloud few;
  few.points.assign(3, Eigen::Vector3f::Zero());
  EXPECT_NE(message_for(few).find("only 3"), std::string::npos);
  for (const float scale : {1000.0F, 0.01F}) {
    PointCloud scaled = three_fruits(false);
    for (auto& p : scaled.points) p *= scale;
    EXPECT_NE(message_for(scaled).find("metres"), std::string::npos) << scale;
  }
}

TEST(EstimateNormals, AreSquareToTheSurfaceAndPointOutward) {
  const Superellipsoid body = pepper(Vec3::Zero());
  std::vector<Vec3> points;
  const auto samples = body.surface_samples(1500);
  for (const SurfacePoint& s : samples) points.push_back(s.point);
  const auto normals = estimate_normals(points, 0.012);
  double worst = 1.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    worst = std::min(worst, normals[i].dot(samples[i].normal));
    mean += normals[i].dot(samples[i].normal) / static_cast<double>(points.size());
  }
  EXPECT_GT(mean, 0.98);
  EXPECT_GT(worst, 0.7);
}

}  // namespace
}  // namespace canopeer
