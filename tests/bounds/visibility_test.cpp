#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "canopeer/base/rng.h"
#include "canopeer/bounds/pipeline_ceiling.h"
#include "canopeer/bounds/visibility/fruit_cutting.h"
#include "canopeer/bounds/visibility/pool_thinning.h"
#include "canopeer/bounds/visibility/view_sampling.h"
#include "canopeer/render/rays/ray_caster.h"
#include "canopeer/render/renderer.h"
#include "canopeer/render/sight_lines.h"
#include "canopeer/scene/worlds.h"
#include "support/must.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

const Scene& world() {
  static const Scene scene = make_world(scenario_1_world(), 1);
  return scene;
}

const CutFruits& cut() {
  static const CutFruits fruits = cut_fruits(world(), 0.01);
  return fruits;
}

TEST(CutFruits, PatchesHaveAllOfTheSurfaceAndNoneIsLarge) {
  const FruitPatches& patches = cut().patches;
  EXPECT_EQ(patches.fruits_total, world().counted_fruits());
  std::vector<double> area(world().fruits.size(), 0.0);
  for (std::size_t p = 0; p < patches.fruit.size(); ++p) {
    area[static_cast<std::size_t>(patches.fruit[p])] += patches.area_cm2[p];
    EXPECT_GT(patches.area_cm2[p], 0.0F);
    EXPECT_LT(patches.area_cm2[p], 4.0F);  // four squares of a patch's side
  }
  for (const FruitTruth& fruit : world().fruits) {
    const double expected = fruit.counted ? fruit.surface_cm2 : 0.0;
    EXPECT_NEAR(area[static_cast<std::size_t>(fruit.id)], expected, 0.01 * expected + 1e-9);
  }
}

TEST(CutFruits, APatchIsOnePieceOfOneFruit) {
  for (const NumberedPart& body : cut().bodies) {
    std::vector<Box> boxes(cut().patches.fruit.size());
    for (std::size_t t = 0; t < body.numbers.size(); ++t) {
      for (const std::uint32_t v : body.part.mesh.triangles[t]) {
        boxes[body.numbers[t]].extend(body.part.mesh.vertices[v].cast<double>());
      }
    }
    for (const Box& box : boxes) {
      if (box.isEmpty()) continue;
      EXPECT_LT(box.sizes().maxCoeff(), 0.035);
    }
  }
}

/// What Embree's rays and the renderer's labels say: which patches the pixels show that are
/// labelled as a counted fruit within the range.
std::set<std::uint32_t> patches_by_rays(const Renderer& renderer, const CameraIntrinsics& camera,
                                        const Pose& pose) {
  std::vector<ScenePart> bodies;
  std::vector<std::uint32_t> numbers;
  for (const NumberedPart& body : cut().bodies) {
    bodies.push_back(body.part);
    numbers.insert(numbers.end(), body.numbers.begin(), body.numbers.end());
  }
  const SurfaceSoup soup = make_surface_soup(bodies);
  const RayCaster caster(soup);
  const RenderedView view = renderer.render(camera, pose);
  std::set<std::uint32_t> seen;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int fruit = view.labels.fruit.at(u, v);
      if (fruit < 0 || !world().fruits[static_cast<std::size_t>(fruit)].counted) continue;
      if (!(view.depth.at(u, v) > 0.0F)) continue;
      const RayCaster::Ray ray{pose.translation().cast<float>(),
                               (pose.linear() * camera.ray(u, v)).cast<float>()};
      RayCaster::Hit hit;
      caster.closest(std::span(&ray, 1), std::span(&hit, 1));
      if (hit.triangle != RayCaster::Hit::kNone) seen.insert(numbers[hit.triangle]);
    }
  }
  return seen;
}

TEST(NumberedView, SeesThePatchesThatRaysMeet) {
  CameraIntrinsics camera = CameraIntrinsics::from_fov(160, 120, 80.0 * std::numbers::pi / 180.0);
  camera.max_range_m = 1.6;
  const Renderer renderer(world());
  std::vector<NumberedPart> parts =
      what_else_is_near(world(), Box(Vec3(-5, -5, -5), Vec3(5, 5, 5)));
  parts.insert(parts.end(), cut().bodies.begin(), cut().bodies.end());
  const NumberedView view(parts);
  Rng rng(1, "views of fruits");
  std::size_t together = 0;
  for (int i = 0; i < 12; ++i) {
    const FruitTruth& fruit = world().fruits[rng.index(world().fruits.size())];
    const Vec3 eye{rng.uniform(-0.3, 0.3), fruit.centre.y() + rng.uniform(-0.6, 0.6),
                   fruit.centre.z() + rng.uniform(-0.3, 0.3)};
    const Pose pose = look_at(eye, fruit.centre, rng.uniform(-3.0, 3.0));
    const std::set<std::uint32_t> expected = patches_by_rays(renderer, camera, pose);
    std::vector<std::uint32_t> seen;
    view.see(camera, pose, seen);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    std::vector<std::uint32_t> differ;
    std::set_symmetric_difference(seen.begin(), seen.end(), expected.begin(), expected.end(),
                                  std::back_inserter(differ));
    // A pixel's centre may lie on the edge between two patches, within rounding.
    EXPECT_LE(differ.size(), 1 + expected.size() / 100) << i;
    together += expected.size();
  }
  EXPECT_GT(together, 300U);
}

TEST(FreeViews, AtAPointItIsInThePicture) {
  const RobotModel& robot = test::test_robot();
  const ArmIk ik = must(ArmIk::make(robot));
  const MotionJudge judge(robot, world());
  const SegmentFrame frame = planned_frame(robot, {{1.0, 0.0}, 1, "one"}, 0);
  CameraIntrinsics camera = CameraIntrinsics::from_fov(160, 120, 80.0 * std::numbers::pi / 180.0);
  camera.max_range_m = 1.6;
  const FreeViews views(robot, ik, world(), judge, frame, camera.min_range_m, camera.max_range_m);
  const SightLines sights(cut().bodies);
  Rng rng(1, "points");
  int drawn = 0;
  for (std::size_t p = 0; p < cut().points.size(); p += 40) {
    const Vec3& target = cut().points[p].front();
    if (!views.may_be_in_range(target)) continue;
    const auto q = views.at_point(
        target, [&](const Vec3& from) { return sights.clear(from, target); }, rng);
    if (!q) continue;
    ++drawn;
    EXPECT_TRUE(robot.within_limits(*q));
    const Pose pose = frame.T_world_base * robot.T_base_camera(*q);
    EXPECT_TRUE(sights.clear(pose.translation(), target));
    const Vec3 seen = pose.inverse(Eigen::Isometry) * target;
    ASSERT_GT(seen.z(), 0.0);
    const Vec3 pixel(camera.fx * seen.x() / seen.z() + camera.cx,
                     camera.fy * seen.y() / seen.z() + camera.cy, 1.0);
    EXPECT_TRUE(pixel.x() > 0.0 && pixel.x() < 160.0 && pixel.y() > 0.0 && pixel.y() < 120.0);
  }
  EXPECT_GT(drawn, 20);
}

TEST(CutFruits, PointsLieOnTheirPatches) {
  ASSERT_EQ(cut().points.size(), cut().patches.fruit.size());
  for (std::size_t p = 0; p < cut().points.size(); ++p) {
    ASSERT_FALSE(cut().points[p].empty());
    const FruitTruth& fruit = world().fruits[static_cast<std::size_t>(cut().patches.fruit[p])];
    for (const Vec3& point : cut().points[p]) EXPECT_LT((point - fruit.centre).norm(), 0.12);
  }
}

TEST(PoolThinning, KeepsHomeAndEverythingThatWasSeen) {
  Rng rng(1, "views to thin");
  FruitPatches patches;
  for (int p = 0; p < 60; ++p) {
    patches.fruit.push_back(p / 20);
    patches.area_cm2.push_back(1.0F);
  }
  std::vector<PoolView> views(300);
  for (PoolView& view : views) {
    view.q = Configuration::Constant(6, rng.uniform(0.0, 0.3));
    for (std::uint32_t p = 0; p < 60; ++p) {
      if (rng.chance(0.1)) view.patches.push_back(p);
    }
  }
  views[0].patches.clear();
  const auto seen_by = [&](const std::vector<std::size_t>& some) {
    std::set<std::uint32_t> seen;
    for (const std::size_t i : some) seen.insert(views[i].patches.begin(), views[i].patches.end());
    return seen.size();
  };
  for (const std::size_t keep : {std::size_t{1000}, std::size_t{80}, std::size_t{1}}) {
    const auto kept = views_to_keep(views, patches, {}, 1.0, keep);
    EXPECT_EQ(kept.front(), 0U);
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    EXPECT_EQ(seen_by(kept), 60U) << keep;
    EXPECT_LT(kept.size(), views.size());
    if (keep == 80) {
      EXPECT_EQ(kept.size(), keep);
    }
  }
  // A view goes for a near one only.
  EXPECT_EQ(views_to_keep(views, patches, {}, 0.0, 1000).size(), views.size());
}

TEST(FindCalibration, FindsTheAreaThatTellsFoundFromNot) {
  const FindCalibration none = calibrate_find({});
  EXPECT_EQ(none.cases, 0);
  std::vector<FindCase> cases;
  for (int i = 1; i <= 100; ++i) cases.push_back({0.1 * i, i > 40});
  cases[9].found = true;    // 1 cm² was enough once
  cases[89].found = false;  // 9 cm² was not
  const FindCalibration find = calibrate_find(cases);
  EXPECT_EQ(find.cases, 100);
  EXPECT_NEAR(find.least_cm2, 1.0, 1e-9);
  EXPECT_GT(find.twentieth_cm2, 4.0);
  EXPECT_NEAR(find.even_cm2, 4.05, 1e-9);
  EXPECT_NEAR(find.wrong_share, 0.02, 1e-9);
}

}  // namespace
}  // namespace canopeer
