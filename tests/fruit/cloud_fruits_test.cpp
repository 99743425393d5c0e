#include "canopeer/fruit/cloud_fruits.h"

#include <gtest/gtest.h>

#include <limits>

#include "canopeer/base/rng.h"
#include "canopeer/fruit/color_ripeness.h"
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

TEST(FitCloud, LeavesOutWhatStandsForNoPointAndCountsIt) {
  const PointCloud clean = three_fruits(true);
  const auto expected = fit_cloud(clean);
  ASSERT_TRUE(expected.has_value());
  EXPECT_TRUE(expected->notices.empty());
  PointCloud cloud = clean;
  const auto add = [&](int count, const Eigen::Vector3f& p) {
    for (int i = 0; i < count; ++i) {
      cloud.points.push_back(p);
      cloud.normals.push_back(Eigen::Vector3f::UnitX());
      cloud.colors.push_back({});
    }
  };
  add(3, Eigen::Vector3f(1e30F, 0, 0));
  add(20000, Eigen::Vector3f::Constant(3.4e38F));  // a sensor's, where nothing came back
  add(4, Eigen::Vector3f(0, -9000, 1));
  add(5, Eigen::Vector3f::Zero());
  add(2, Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity()));
  const auto fitted = fit_cloud(cloud);
  ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
  ASSERT_EQ(fitted->fruits.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(fitted->fruits[k].centre, expected->fruits[k].centre);
  }
  EXPECT_EQ(fitted->notices, (std::vector<std::string>{"left out: 2 points that are not finite",
                                                       "left out: 20007 points beyond 2000 m",
                                                       "left out: 5 points at 0 0 0"}));
}

TEST(FitCloud, ColourTellsRipeness) {
  const std::pair<Rgb, PixelLabel> cases[] = {{{200, 40, 10}, PixelLabel::ripe_fruit},
                                              {{220, 120, 20}, PixelLabel::turning_fruit},
                                              {{60, 130, 40}, PixelLabel::green_fruit},
                                              {{120, 118, 119}, PixelLabel::background}};
  for (const auto& [color, ripeness] : cases) {
    EXPECT_EQ(ripeness_of_color(color), ripeness);
    PointCloud cloud = three_fruits(true);
    cloud.colors.assign(cloud.points.size(), color);
    const auto fitted = fit_cloud(cloud);
    ASSERT_TRUE(fitted.has_value());
    ASSERT_EQ(fitted->fruits.size(), 3U);
    for (const FruitEstimate& f : fitted->fruits) EXPECT_EQ(f.ripeness, ripeness);
  }
  EXPECT_EQ(ripeness_of_color({200, 20, 60}), PixelLabel::ripe_fruit);  // hue −13°
  EXPECT_EQ(ripeness_of_color({20, 40, 200}), PixelLabel::background);
  EXPECT_EQ(ripeness_of_color({12, 2, 1}), PixelLabel::background);
  EXPECT_EQ(ripeness_of_surface({{200, 40, 10}, {200, 40, 10}, {60, 130, 40}}),
            PixelLabel::ripe_fruit);
  EXPECT_EQ(ripeness_of_surface({}), PixelLabel::background);
}

TEST(FitCloud, SaysWhyThereIsNothingToFit) {
  EXPECT_NE(message_for({}).find("empty"), std::string::npos);
  PointCloud nan;
  nan.points.assign(100, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_NE(message_for(nan).find("none of the 100 points is finite"), std::string::npos);
  PointCloud few;
  few.points.assign(3, Eigen::Vector3f::Ones());
  EXPECT_NE(message_for(few).find("only 3"), std::string::npos);
  few.points.push_back(Eigen::Vector3f::Constant(1e9F));
  EXPECT_NE(message_for(few).find("only 3 of 4 finite points"), std::string::npos);
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
