#include "canopeer/render/renderer.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/scene/plants/plant.h"
#include "canopeer/scene/worlds.h"
#include "reference_view.h"

namespace canopeer {
namespace {

constexpr double kFov = 80.0 * std::numbers::pi / 180.0;

ScenePart part_of(TriangleMesh mesh, PartClass kind, Rgb color) {
  ScenePart part;
  part.mesh = std::move(mesh);
  compute_normals(part.mesh);
  part.kind = kind;
  part.color = color;
  return part;
}

/// Triangles from parallels and meridians; vertices on the sphere.
TriangleMesh make_sphere(const Vec3& centre, double radius, std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t k = 0; k < 2 * n; ++k) {
      const double polar = std::numbers::pi * i / n;
      const double azimuth = std::numbers::pi * k / n;
      const Vec3 d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                   std::cos(polar));
      mesh.vertices.emplace_back((centre + radius * d).cast<float>());
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < 2 * n; ++k) {
      const std::uint32_t a = i * 2 * n + k;
      const std::uint32_t b = i * 2 * n + (k + 1) % (2 * n);
      mesh.triangles.push_back({a, a + 2 * n, b + 2 * n});
      mesh.triangles.push_back({a, b + 2 * n, b});
    }
  }
  return mesh;
}

Scene one_part(ScenePart part) {
  Scene scene;
  scene.parts.push_back(std::move(part));
  return scene;
}

TEST(Renderer, DepthOfAPlaneIsAlongTheOpticalAxis) {
  // A face square to the axis is equally deep everywhere; all the way to the corners.
  const Scene scene = one_part(
      part_of(make_box(Box(Vec3(1, -5, -5), Vec3(2, 5, 5))), PartClass::structure, {90, 90, 90}));
  const auto camera = CameraIntrinsics::from_fov(160, 120, kFov);
  const RenderedView view =
      Renderer(scene).render(camera, look_at(Vec3(-0.25, 0.1, 0.2), Vec3(1, 0.1, 0.2)));
  for (const float d : view.depth.pixels()) ASSERT_NEAR(d, 1.25, 1e-4);
}

TEST(Renderer, DepthOfASphereIsTheAnalyticOneAtThePixelCentre) {
  const Vec3 centre(0.9, 0.05, -0.03);
  const double radius = 0.2;
  const Scene scene =
      one_part(part_of(make_sphere(centre, radius, 360), PartClass::fruit, {200, 40, 10}));
  const auto camera = CameraIntrinsics::from_fov(160, 120, kFov);
  const Pose T_world_camera = look_at(Vec3(0, 0.2, 0.1), centre, 0.4);
  const RenderedView view = Renderer(scene).render(camera, T_world_camera);
  const Vec3 c = T_world_camera.inverse(Eigen::Isometry) * centre;
  int inside = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 ray = camera.ray(u, v);
      const double a = ray.squaredNorm();
      const double b = ray.dot(c);
      const double discriminant = b * b - a * (c.squaredNorm() - radius * radius);
      if (discriminant < 0.0) {
        ASSERT_EQ(view.depth.at(u, v), 0.0F) << u << " " << v;
        continue;
      }
      const double depth = (b - std::sqrt(discriminant)) / a;
      // At the rim the facets are seen edge-on; chord and sphere differ by 8e-6 m elsewhere.
      if (discriminant < 0.02 * a * radius * radius) continue;
      ++inside;
      ASSERT_NEAR(view.depth.at(u, v), depth, 1e-4) << u << " " << v;
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(Renderer, GivesNoDepthOutsideTheRangeButStillColour) {
  Scene scene = one_part(
      part_of(make_box(Box(Vec3(1, -5, -5), Vec3(2, 5, 5))), PartClass::structure, {90, 90, 90}));
  auto camera = CameraIntrinsics::from_fov(32, 24, kFov);
  const Renderer renderer(scene);
  const auto depth_from = [&](double x) {
    const RenderedView view = renderer.render(camera, look_at(Vec3(x, 0, 0), Vec3(1, 0, 0)));
    EXPECT_EQ(view.labels.kind.at(16, 12), static_cast<std::uint8_t>(PartClass::structure));
    EXPECT_GT(view.color.at(16, 12).r, 10);
    return view.depth.at(16, 12);
  };
  EXPECT_EQ(depth_from(0.86), 0.0F);
  EXPECT_NEAR(depth_from(0.84), 0.16, 1e-4);
  EXPECT_NEAR(depth_from(-1.99), 2.99, 1e-4);
  EXPECT_EQ(depth_from(-2.01), 0.0F);
  const RenderedView away = renderer.render(camera, look_at(Vec3(0, 0, 0), Vec3(-1, 0, 0)));
  EXPECT_EQ(away.labels.kind.at(5, 5), Labels::kNothing);
  EXPECT_EQ(away.labels.fruit.at(5, 5), -1);
}

TEST(Renderer, IsTheSameWithOneThreadAndWithTwo) {
  const Renderer renderer(make_world(scenario_1_world(), 1));
  const auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  const Pose pose = look_at(Vec3(0, 0.3, 0.9), Vec3(-0.75, 0.3, 0.5));
  RenderedView one;
  RenderedView two;
  oneapi::tbb::task_arena(1).execute([&] { one = renderer.render(camera, pose); });
  oneapi::tbb::task_arena(2).execute([&] { two = renderer.render(camera, pose); });
  EXPECT_TRUE(one.depth.pixels() == two.depth.pixels());
  EXPECT_TRUE(one.color.pixels() == two.color.pixels());
  EXPECT_TRUE(one.labels.fruit.pixels() == two.labels.fruit.pixels());
  const Renderer again(make_world(scenario_1_world(), 1));
  EXPECT_TRUE(again.render(camera, pose).depth.pixels() == one.depth.pixels());
}

TEST(Renderer, ShowsDepthColourAndLabelsOfWhatRaysMeet) {
  const Scene scene = make_world(scenario_1_world(), 2);
  auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  camera.max_range_m = 100.0;
  camera.min_range_m = 0.0;
  const Pose pose = look_at(Vec3(-0.12, 0.2, 0.78), Vec3(0.75, 0.2, 0.68));
  const SurfaceSoup soup = make_surface_soup(scene.parts);
  LensDistortion lens;
  lens.k1 = -0.1;
  for (const bool shadows : {false, true}) {
    for (const CameraRays& rays : {CameraRays(camera), CameraRays(camera, lens)}) {
      RenderOptions options;
      options.shadows = shadows;
      options.color_noise = 0.0;
      const RenderedView view = Renderer(scene, options).render(rays, pose);
      const auto reference = testing_support::reference_view(scene, rays, pose, options);
      int different = 0;
      for (std::size_t i = 0; i < reference.hits.size(); ++i) {
        const RayCaster::Hit& hit = reference.hits[i];
        const bool nothing = hit.triangle == RayCaster::Hit::kNone;
        const Rgb& c = view.color.pixels()[i];
        const Eigen::Vector3f& r = reference.colors[i];
        const auto off = [](std::uint8_t a, float b) {
          return std::abs(static_cast<float>(a) - std::clamp(b, 0.0F, 255.0F));
        };
        bool same = off(c.r, r.x()) < 1.5F && off(c.g, r.y()) < 1.5F && off(c.b, r.z()) < 1.5F;
        if (nothing) {
          same = same && view.labels.kind.pixels()[i] == Labels::kNothing;
        } else {
          const SurfaceSoup::Part& part = soup.parts[soup.triangles[hit.triangle].part];
          same = same && std::abs(view.depth.pixels()[i] - hit.distance) < 1e-5F &&
                 view.labels.kind.pixels()[i] == static_cast<std::uint8_t>(part.kind) &&
                 view.labels.fruit.pixels()[i] == part.fruit;
        }
        different += !same;
      }
      // Shadows end, and rays pass edges, within rounding here and there.
      EXPECT_LT(different, shadows ? 60 : 6);
    }
  }
}

TEST(Renderer, GivesTheSameBytesAtEveryLevelAndWithAnyNumberOfThreads) {
  const Scene scene = make_world(*named_world("scenario_1"), 1);
  CameraIntrinsics camera{203, 117, 130.0, 128.0, 100.25, 60.5};
  const Pose pose = look_at(Vec3(0, 0.3, 0.9), Vec3(-0.75, 0.3, 0.5), 0.1);
  RenderOptions options;
  options.simd = SimdLevel::scalar;
  const RenderedView expected = Renderer(scene, options).render(camera, pose);
  for (const SimdLevel level : kSimdLevels) {
    if (level > best_simd_level()) continue;
    options.simd = level;
    const Renderer renderer(scene, options);
    for (const int threads : {1, 2}) {
      RenderedView view;
      oneapi::tbb::task_arena(threads).execute([&] { view = renderer.render(camera, pose); });
      EXPECT_TRUE(view.depth.pixels() == expected.depth.pixels()) << simd_level_name(level);
      EXPECT_TRUE(view.color.pixels() == expected.color.pixels()) << simd_level_name(level);
      EXPECT_TRUE(view.labels.fruit.pixels() == expected.labels.fruit.pixels());
      EXPECT_TRUE(view.labels.kind.pixels() == expected.labels.kind.pixels());
    }
  }
}

TEST(Renderer, LabelsAndDepthMeetOnTheFruits) {
  const Scene scene = make_world(scenario_1_world(), 4);
  const Renderer renderer(scene);
  const auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  int pixels = 0;
  for (const double y : {-1.0, 0.0, 1.0}) {
    const Pose T_world_camera = look_at(Vec3(-0.2, y, 0.9), Vec3(0.75, y, 0.5));
    const RenderedView view = renderer.render(camera, T_world_camera);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const int id = view.labels.fruit.at(u, v);
        const bool body = view.labels.kind.at(u, v) == static_cast<std::uint8_t>(PartClass::fruit);
        ASSERT_EQ(id >= 0, body);
        if (id < 0 || view.depth.at(u, v) <= 0.0F) continue;
        const Vec3 p = T_world_camera * (view.depth.at(u, v) * camera.ray(u, v));
        const FruitTruth& fruit = scene.fruits[static_cast<std::size_t>(id)];
        ASSERT_LT((p - fruit.centre).norm(), 0.7 * std::max(fruit.length_m, fruit.diameter_m));
        ++pixels;
      }
    }
  }
  EXPECT_GT(pixels, 500);
}

TEST(Renderer, RipeFruitsAreSeenRedFromTheAisle) {
  const Scene scene = make_world(scenario_1_world(), 1);
  const Renderer renderer(scene);
  const auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  std::vector<int> most(scene.fruits.size(), 0);
  int red = 0;
  int body = 0;
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-0.3, 0.3}) {
      for (const double z : {0.75, 1.2}) {
        for (double y = -2.0; y < 2.0; y += 0.25) {
          const RenderedView view =
              renderer.render(camera, look_at(Vec3(x, y, z), Vec3(side * 0.75, y, 0.45)));
          std::vector<int> seen(scene.fruits.size(), 0);
          for (std::size_t i = 0; i < view.depth.pixels().size(); ++i) {
            const int id = view.labels.fruit.pixels()[i];
            const float d = view.depth.pixels()[i];
            if (id < 0 || d <= 0.0F || d > 1.2F) continue;
            ++seen[static_cast<std::size_t>(id)];
            if (!scene.fruits[static_cast<std::size_t>(id)].counted) continue;
            const Rgb& c = view.color.pixels()[i];
            ++body;
            red += c.r > c.g + 30 && c.r > c.b + 30;
          }
          for (std::size_t i = 0; i < seen.size(); ++i) most[i] = std::max(most[i], seen[i]);
        }
      }
    }
  }
  int visible = 0;
  for (const FruitTruth& f : scene.fruits) {
    // 50 pixels here are 200 at 640 × 480.
    visible += f.counted && most[static_cast<std::size_t>(f.id)] >= 50;
  }
  EXPECT_GE(visible, 43);
  EXPECT_GT(red, 0.95 * body);
}

/// A wall at x = 1 whose texture has a hole in the half of greater y, and a red wall behind it.
Scene wall_with_a_hole() {
  ScenePart front;
  front.mesh.vertices = {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}};
  front.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  front.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  front.kind = PartClass::leaf;
  Texture texture;
  texture.color = ColorImage(2, 1, {20, 200, 30});
  texture.opacity = Image<std::uint8_t>(2, 1, 255);
  texture.opacity.at(1, 0) = 0;
  front.texture = std::make_shared<const Texture>(texture);
  Scene scene = one_part(front);
  scene.parts.push_back(
      part_of(make_box(Box(Vec3(2, -3, -3), Vec3(2.5, 3, 3))), PartClass::fruit, {200, 20, 20}));
  scene.parts.back().fruit = 0;
  return scene;
}

TEST(Renderer, LooksThroughTheHolesOfATexture) {
  const auto camera = CameraIntrinsics::from_fov(64, 48, kFov);
  const Pose pose = look_at(Vec3(0, 0, 0), Vec3(1, 0, 0));  // greater y to the left
  const RenderedView view = Renderer(wall_with_a_hole()).render(camera, pose);
  for (const auto& [u, leaf] : {std::pair{24, false}, std::pair{40, true}}) {
    const Rgb c = view.color.at(u, 24);
    EXPECT_NEAR(view.depth.at(u, 24), leaf ? 1.0 : 2.0, 1e-4);
    EXPECT_EQ(c.g > c.r, leaf);
    EXPECT_EQ(view.labels.kind.at(u, 24),
              static_cast<std::uint8_t>(leaf ? PartClass::leaf : PartClass::fruit));
    EXPECT_EQ(view.labels.fruit.at(u, 24), leaf ? -1 : 0);
  }
}

TEST(Renderer, LightFallsThroughTheHolesOfATexture) {
  RenderOptions options;
  options.shadows = true;
  options.color_noise = 0.0;
  options.light_direction = Vec3(-1, 0, 0);
  Scene scene = wall_with_a_hole();
  const auto camera = CameraIntrinsics::from_fov(64, 48, kFov);
  // From between the walls, looking at the rear one.
  const Pose pose = look_at(Vec3(1.2, 0, 0), Vec3(2, 0, 0));
  const RenderedView view = Renderer(scene, options).render(camera, pose);
  EXPECT_GT(view.color.at(20, 24).r, view.color.at(44, 24).r + 20);
}

TEST(Renderer, ShowsVertexColoursAndNoGlass) {
  Scene scene = wall_with_a_hole();
  ScenePart glass = part_of(make_box(Box(Vec3(0.5, -3, -3), Vec3(0.6, 3, 3))), PartClass::structure,
                            {255, 255, 255});
  glass.see_through = true;
  scene.parts.push_back(glass);
  scene.parts[0].texture = nullptr;
  scene.parts[0].vertex_colors.assign(4, {10, 20, 250});
  const auto camera = CameraIntrinsics::from_fov(64, 48, kFov);
  const RenderedView view = Renderer(scene).render(camera, look_at(Vec3(0, 0, 0), Vec3(1, 0, 0)));
  EXPECT_NEAR(view.depth.at(32, 24), 1.0, 1e-4);
  const Rgb c = view.color.at(32, 24);
  EXPECT_GT(c.b, c.r + 50);
}

TEST(Renderer, ACopyOfAModelLooksLikeTheModelInItsPlace) {
  // The same plant as parts of the scene, and as a copy of a model.
  Rng rng(3);
  const Plant plant = grow_plant(plant_kind(6), rng);
  const Pose T = Eigen::Translation3d(0.9, 0.2, 0.0) * Eigen::AngleAxisd(1.0, Vec3::UnitZ());
  Scene placed;
  for (const ScenePart& part : plant.parts) {
    ScenePart world = part;
    world.mesh = {};
    world.mesh.append(part.mesh, T);
    if (world.fruit >= 0) world.fruit += 5;
    placed.parts.push_back(world);
  }
  Scene copied;
  copied.models.push_back({plant.parts});
  copied.instances.push_back({0, T, 2, 5, 1.0F});
  const auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  const Pose pose = look_at(Vec3(0, 0.1, 0.6), Vec3(0.9, 0.2, 0.4));
  RenderOptions options;
  options.shadows = true;
  const RenderedView a = Renderer(placed, options).render(camera, pose);
  const RenderedView b = Renderer(copied, options).render(camera, pose);
  int different = 0;
  int fruit = 0;
  for (std::size_t i = 0; i < a.depth.pixels().size(); ++i) {
    const Rgb& c = a.color.pixels()[i];
    const Rgb& d = b.color.pixels()[i];
    const bool same = std::abs(a.depth.pixels()[i] - b.depth.pixels()[i]) < 1e-4F &&
                      a.labels.fruit.pixels()[i] == b.labels.fruit.pixels()[i] &&
                      std::abs(c.r - d.r) < 3 && std::abs(c.g - d.g) < 3;
    different += !same;
    fruit += b.labels.fruit.pixels()[i] >= 5;
  }
  // Rounding moves some edges by a pixel.
  EXPECT_LT(different, 0.01 * static_cast<double>(a.depth.pixels().size()));
  EXPECT_GT(fruit, 100);
}

}  // namespace
}  // namespace canopeer
