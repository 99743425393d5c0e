#include "canopeer/fruit/fruit_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../detect/synthetic_view.h"
#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

using namespace synthetic;

const Vec3 kFruit(0.6, 0.0, 0.6);
const Vec3 kFront(0.0, 0.0, 0.75);

Body pepper(const Vec3& centre, const Vec3& semi_axes = {0.033, 0.033, 0.038}) {
  return superellipsoid(centre, semi_axes, 0.7, kRipe, true);
}

/// Reddish thing that the detector let through.
Body red(Body body) {
  body.color = kRipe;
  body.fruit = true;
  return body;
}

std::vector<FruitEstimate> map_of(const std::vector<Body>& bodies, const std::vector<Vec3>& from,
                                  const Vec3& to = kFruit) {
  FruitMap map;
  for (const Vec3& camera : from) {
    const View view = look(bodies, camera, to);
    map.add(view.frame, view.fruit);
  }
  map.update();
  return map.fruits();
}

std::vector<Vec3> around(double half_angle) {
  std::vector<Vec3> cameras;
  for (const double angle : {-half_angle, 0.0, half_angle}) {
    cameras.emplace_back(0.6 - 0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.7);
  }
  return cameras;
}

TEST(FruitMap, PlacesAFruitSeenFromOneSideWithinOneAndAHalfCentimetres) {
  Rng rng(5);
  for (int i = 0; i < 8; ++i) {
    const double radius = rng.uniform(0.026, 0.040);
    const Vec3 semi_axes{radius, radius * rng.uniform(0.85, 1.0), rng.uniform(0.030, 0.046)};
    const Vec3 centre = kFruit + Vec3{rng.uniform(-0.1, 0.1), rng.uniform(-0.08, 0.08), 0.0};
    const auto fruits = map_of({pepper(centre, semi_axes)}, {kFront});
    ASSERT_EQ(fruits.size(), 1U) << "fruit " << i;
    EXPECT_LT((fruits[0].centre - centre).norm(), 0.015) << "fruit " << i;
    EXPECT_NEAR(fruits[0].semi_axes_m.x(), radius, 0.007);
    EXPECT_NEAR(fruits[0].semi_axes_m.z(), semi_axes.z(), 0.010);
  }
}

TEST(FruitMap, MeasuresAFruitSeenFromThreeSides) {
  const auto fruits = map_of({pepper(kFruit)}, around(1.0));
  ASSERT_EQ(fruits.size(), 1U);
  EXPECT_LT((fruits[0].centre - kFruit).norm(), 0.006);
  EXPECT_NEAR(fruits[0].volume_cm3, 220.0, 60.0);
  EXPECT_GT(fruits[0].confidence, 0.6);
}

TEST(FruitMap, PutsTheFragmentsOfAFruitBehindLeavesTogether) {
  std::vector<Body> bodies = {pepper(kFruit)};
  for (const double y : {-0.014, 0.012}) {  // two upright stripes, 1.2 cm wide, 5 cm in front
    bodies.push_back(block(Box(Vec3(0.52, y - 0.006, 0.5), Vec3(0.522, y + 0.006, 0.7)), kLeaf));
  }
  const auto fruits = map_of(bodies, {kFront});
  ASSERT_EQ(fruits.size(), 1U);
  EXPECT_LT((fruits[0].centre - kFruit).norm(), 0.02);
}

TEST(FruitMap, TellsTouchingFruitsApart) {
  for (const Vec3& offset : {Vec3(0.0, 0.067, 0.0), Vec3(0.02, 0.062, 0.02), Vec3(0, 0, 0.078)}) {
    const Vec3 second = kFruit + offset;
    const auto fruits = map_of({pepper(kFruit), pepper(second)}, around(0.5));
    ASSERT_EQ(fruits.size(), 2U) << offset.transpose();
    for (const Vec3& centre : {kFruit, second}) {
      const double nearest =
          std::min((fruits[0].centre - centre).norm(), (fruits[1].centre - centre).norm());
      EXPECT_LT(nearest, 0.012) << offset.transpose();
    }
  }
}

TEST(FruitMap, LeavesOutClipsLabelsStringsPipesAndWhatLiesOnTheFloor) {
  const Vec3 clip_half = Vec3::Constant(0.01);
  const std::vector<std::pair<const char*, Body>> things = {
      {"clip", block(Box(kFruit - clip_half, kFruit + clip_half), kRipe)},
      {"label",
       block(Box(kFruit - Vec3(0.001, 0.05, 0.03), kFruit + Vec3(0.001, 0.05, 0.03)), kRipe)},
      {"string", bar(kFruit - Vec3(0, 0, 0.3), kFruit + Vec3(0, 0, 0.3), 0.003, kRipe)},
      {"pipe", bar(kFruit - Vec3(0, 0.4, 0), kFruit + Vec3(0, 0.4, 0), 0.026, kRipe)},
      {"fallen fruit", pepper({0.6, 0.0, 0.04})},
  };
  for (const auto& [name, body] : things) {
    EXPECT_TRUE(map_of({red(body)}, around(0.7)).empty()) << name;
  }
}

TEST(FruitMap, IsLessSureOfASpotWhoseSurfaceGoesOnAsSomethingElse) {
  FruitMap whole;
  FruitMap spot;
  for (const Vec3& camera : around(0.5)) {
    View view = look({pepper(kFruit)}, camera, kFruit);
    whole.add(view.frame, view.fruit);
    for (int v = 0; v < view.fruit.height(); ++v) {
      for (int u = 0; u < view.fruit.width(); ++u) {
        const Vec3 p = view.frame.T_world_camera *
                       (double{view.frame.depth.at(u, v)} * view.frame.intrinsics.ray(u, v));
        if (p.z() < kFruit.z()) view.fruit.at(u, v) = 0;
      }
    }
    spot.add(view.frame, view.fruit);
  }
  whole.update();
  spot.update();
  ASSERT_EQ(whole.candidates().size(), 1U);
  ASSERT_EQ(spot.candidates().size(), 1U);
  EXPECT_LT(whole.evidence(0).foreign_share, 0.05);
  EXPECT_LT(whole.evidence(0).free_share, 0.05);
  EXPECT_GT(spot.evidence(0).foreign_share, 0.2);
  EXPECT_LT(spot.candidates()[0].confidence, whole.candidates()[0].confidence);
}

TEST(FruitMap, PutsOffWhatIsTooMuchForOneUpdateAndMissesNothingInTheEnd) {
  std::vector<Body> bodies;
  for (int i = 0; i < 4; ++i) bodies.push_back(pepper(kFruit + Vec3(0.0, 0.16 * (i - 1.5), 0.0)));
  FruitMapOptions hurried;
  hurried.update_points = 1;  // one known patch at a time
  FruitMap map(hurried);
  FruitMap patient;
  for (int frame = 0; frame < 3; ++frame) {
    View view = look(bodies, kFront + Vec3(0.0, 0.1 * frame, 0.0), kFruit);
    view.frame.time_s = frame;
    map.add(view.frame, view.fruit);
    patient.add(view.frame, view.fruit);
    map.update();
    patient.update();
    EXPECT_EQ(map.fruits().size(), 4U) << frame;  // new fruits never wait
  }
  EXPECT_LT(map.fits(), patient.fits());
  map.update_all();
  patient.update_all();
  EXPECT_EQ(map.waiting(), 0);
  ASSERT_EQ(map.fruits().size(), patient.fruits().size());
  for (const FruitEstimate& f : map.fruits()) {
    const auto same = [&](const FruitEstimate& other) {
      return other.centre == f.centre && other.volume_cm3 == f.volume_cm3 &&
             other.views == f.views && other.first_seen_s == f.first_seen_s;
    };
    EXPECT_TRUE(std::any_of(patient.fruits().begin(), patient.fruits().end(), same)) << f.id;
  }
}

TEST(FruitMap, KeepsTheIdOfAFruitWhileMoreOfItIsSeen) {
  const Vec3 other = kFruit + Vec3(0.0, 0.14, 0.0);
  const std::vector<Body> bodies = {pepper(kFruit), pepper(other)};
  FruitMap map;
  const View first = look(bodies, kFront, kFruit);
  Mask only_first_fruit = first.fruit;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const Vec3 p = first.frame.T_world_camera *
                     (double{first.frame.depth.at(u, v)} * first.frame.intrinsics.ray(u, v));
      if (p.y() > 0.07) only_first_fruit.at(u, v) = 0;
    }
  }
  map.add(first.frame, only_first_fruit);
  map.update();
  ASSERT_EQ(map.fruits().size(), 1U);
  EXPECT_EQ(map.fruits()[0].id, 0);
  for (const Vec3& camera : around(1.0)) {
    const View view = look(bodies, camera, kFruit);
    map.add(view.frame, view.fruit);
    map.update();
  }
  ASSERT_EQ(map.fruits().size(), 2U);
  EXPECT_LT((map.fruits()[0].centre - kFruit).norm(), 0.01);
  EXPECT_LT((map.fruits()[1].centre - other).norm(), 0.02);
  EXPECT_EQ(map.fruits()[1].id, 1);
}

TEST(FruitMap, KnowsNothingBeforeItSeesAnythingAndKeepsItsColours) {
  FruitMap map;
  map.update();
  EXPECT_TRUE(map.fruits().empty());
  EXPECT_TRUE(map.cloud().points.empty());
  const View view = look({pepper(kFruit)}, kFront, kFruit);
  map.add(view.frame, view.fruit);
  EXPECT_TRUE(map.cloud().points.empty());  // there is no surface before an update
  map.update();
  const PointCloud cloud = map.cloud();
  ASSERT_GT(cloud.points.size(), 100U);
  ASSERT_EQ(cloud.colors.size(), cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_GT(cloud.colors[i].r, 2 * cloud.colors[i].g);
    EXPECT_NEAR(cloud.normals[i].norm(), 1.0F, 1e-4F);
    // Seen from the front, so the surface faces it.
    EXPECT_GT(cloud.normals[i].cast<double>().dot(kFront - cloud.points[i].cast<double>()), 0.0);
  }
}

TEST(FruitMap, IncrementalUpdatesEndLikeOneUpdate) {
  const std::vector<Body> bodies = {pepper(kFruit), pepper(kFruit + Vec3(0, 0.12, 0.05)),
                                    pepper(kFruit + Vec3(0.05, -0.13, 0))};
  FruitMap stepwise;
  FruitMap at_once;
  for (const Vec3& camera : around(0.6)) {
    const View view = look(bodies, camera, kFruit);
    stepwise.add(view.frame, view.fruit);
    stepwise.update();
    at_once.add(view.frame, view.fruit);
  }
  at_once.update();
  ASSERT_EQ(stepwise.fruits().size(), 3U);
  ASSERT_EQ(at_once.fruits().size(), 3U);
  for (const FruitEstimate& a : stepwise.fruits()) {
    // A fit goes on from the last one, so it may stop a little elsewhere.
    const auto same = [&](const FruitEstimate& b) {
      return (a.centre - b.centre).norm() < 0.001 &&
             std::abs(a.volume_cm3 - b.volume_cm3) < 0.05 * b.volume_cm3 && a.points == b.points;
    };
    EXPECT_EQ(std::count_if(at_once.fruits().begin(), at_once.fruits().end(), same), 1)
        << a.centre.transpose();
  }
}

TEST(FruitMap, ReportsTwoFruitsSevenCentimetresApartAsTwo) {
  const Vec3 small(0.030, 0.030, 0.034);
  for (const Vec3& offset : {Vec3(0, 0.07, 0), Vec3(0, 0.05, 0.049), Vec3(0, 0, 0.07)}) {
    const auto fruits =
        map_of({pepper(kFruit, small), pepper(kFruit + offset, small)}, around(0.5));
    ASSERT_EQ(fruits.size(), 2U) << offset.transpose();
    EXPECT_NEAR((fruits[0].centre - fruits[1].centre).norm(), 0.07, 0.012);
  }
}

TEST(FruitMap, PutsTheTwoSidesOfAFruitSeenFromBothSidesOfTheRowTogether) {
  FruitMap map;
  for (const double x : {0.1, 1.1}) {
    const View view = look({pepper(kFruit)}, {x, 0.0, 0.65}, kFruit);
    map.add(view.frame, view.fruit);
    map.update();
    ASSERT_EQ(map.fruits().size(), 1U);
    EXPECT_EQ(map.fruits()[0].id, 0);
  }
  EXPECT_LT((map.fruits()[0].centre - kFruit).norm(), 0.004);
  EXPECT_EQ(map.fruits()[0].views, 2);
  EXPECT_GT(map.fruits()[0].seen_share, 0.8);
}

TEST(FruitMap, FitsOnlyWhatChanged) {
  const Vec3 other = kFruit + Vec3(0.0, 0.5, 0.0);
  const std::vector<Body> bodies = {pepper(kFruit), pepper(other)};
  FruitMap map;
  const View first = look(bodies, kFront, kFruit);
  const View second = look(bodies, kFront + Vec3(0, 0.5, 0), other);
  map.add(first.frame, first.fruit);
  map.update();
  const int fits_of_first = map.fits();
  map.add(second.frame, second.fruit);
  map.update();
  EXPECT_EQ(map.fruits().size(), 2U);
  EXPECT_EQ(map.fits(), fits_of_first + 1);
  map.update();
  EXPECT_EQ(map.fits(), fits_of_first + 1);
}

TEST(FruitMap, KeepsWhenAndHowOftenAFruitWasSeenAndHowRipeItIs) {
  FruitMapOptions options;
  options.rows = {{"A", {0.6, -1.0, 0.0}, Vec3::UnitY()}};
  FruitMap map(options);
  double time_s = 10.0;
  for (const Vec3& camera : around(0.5)) {
    View view = look({pepper(kFruit)}, camera, kFruit);
    view.frame.time_s = time_s;
    time_s += 2.0;
    for (auto& label : view.fruit.pixels()) label = label != 0 ? 3 : 0;
    map.add(view.frame, view.fruit);
    map.update();
  }
  ASSERT_EQ(map.fruits().size(), 1U);
  const FruitEstimate& fruit = map.fruits()[0];
  EXPECT_EQ(fruit.views, 3);
  EXPECT_EQ(fruit.first_seen_s, 10.0);
  EXPECT_EQ(fruit.last_seen_s, 14.0);
  EXPECT_EQ(fruit.ripeness, PixelLabel::ripe_fruit);
  EXPECT_GT(fruit.color.r, 2 * fruit.color.g);
  ASSERT_TRUE(fruit.place.has_value());
  EXPECT_EQ(fruit.place->row, "A");
  EXPECT_NEAR(fruit.place->along_m, 1.0, 0.01);
  EXPECT_NEAR(fruit.place->height_m, 0.6, 0.01);
}

TEST(FruitMap, SurfaceHasTheIdOfItsFruit) {
  const Vec3 other = kFruit + Vec3(0.0, 0.15, 0.0);
  FruitMap map;
  const View view = look({pepper(kFruit), pepper(other)}, kFront, kFruit);
  map.add(view.frame, view.fruit);
  map.update();
  ASSERT_EQ(map.fruits().size(), 2U);
  const SurfaceMesh surface = map.surface();
  ASSERT_EQ(surface.fruit.size(), surface.vertices.size());
  EXPECT_GT(surface.triangles.size(), 300U);
  int owned = 0;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    if (surface.fruit[i] < 0) continue;
    ++owned;
    const FruitEstimate& fruit = map.fruits()[static_cast<std::size_t>(surface.fruit[i])];
    EXPECT_LT((surface.vertices[i].surface.point - fruit.centre).norm(), 0.07);
  }
  EXPECT_GT(owned, 0.9 * static_cast<double>(surface.vertices.size()));
}

}  // namespace
}  // namespace canopeer
