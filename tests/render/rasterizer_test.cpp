#include "canopeer/render/raster/rasterizer.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <numbers>

#include "canopeer/base/rng.h"
#include "canopeer/render/surfaces/surface_plane.h"
#include "canopeer/scene/worlds.h"
#include "reference_view.h"

namespace canopeer {
namespace {

using testing_support::reference_view;

constexpr double kFov = 80.0 * std::numbers::pi / 180.0;

/// A soup and its groups, drawn as the world.
struct Drawing {
  explicit Drawing(const std::vector<ScenePart>& parts)
      : soup(make_surface_soup(parts)), clusters(make_triangle_clusters(soup)) {}

  [[nodiscard]] std::vector<VisibleSurface> draw(const CameraIntrinsics& camera, const Pose& pose,
                                                 SimdLevel level = best_simd_level()) const {
    const Rasterizer rasterizer({{&soup, &clusters, Pose::Identity()}}, level);
    const VisibleImage image = rasterizer.draw(camera, pose);
    std::vector<VisibleSurface> pixels;
    std::vector<VisibleRun> runs;
    for (int v = 0; v < camera.height; ++v) {
      image.row(v, &runs);
      for (const VisibleRun& run : runs)
        pixels.insert(pixels.end(), run.end - run.begin, run.surface);
    }
    return pixels;
  }

  SurfaceSoup soup;
  TriangleClusters clusters;
};

/// How a ray meets a triangle, in double precision.
struct Meeting {
  double depth = 0.0;
  double pixels_inside = 0.0;  ///< how far the pixel is inside the triangle; < 0: outside
};

Meeting meet(const SurfaceSoup& soup, std::uint32_t triangle, const CameraIntrinsics& camera,
             const Pose& pose, int u, int v) {
  const BodyRays rays(Pose::Identity(), pose);
  const SurfacePlane plane(soup, triangle, rays.eye);
  const Vec3 ray = camera.ray(u, v);
  const Vec3 d = rays.direction(ray.x(), ray.y());
  const Vec3 weights = plane.weights(d);
  Meeting meeting;
  meeting.pixels_inside = 1e9;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    meeting.depth += weights[i] * rays.ahead.dot(plane.corner[k]);
    const Eigen::Vector2d slope(plane.edge[k].dot(rays.right) / camera.fx,
                                plane.edge[k].dot(rays.down) / camera.fy);
    const double distance = std::abs(plane.edge[k].dot(d)) / slope.norm();
    meeting.pixels_inside =
        std::min(meeting.pixels_inside, weights[i] < 0.0 ? -distance : distance);
  }
  return meeting;
}

/// All pixels that differ from what Embree's rays meet pass an edge within rounding, or meet two
/// surfaces within rounding of each other.
void expect_as_embree(const Scene& scene, const CameraIntrinsics& camera, const Pose& pose) {
  constexpr double kEdge = 2e-3;   // pixels
  constexpr double kDepth = 1e-5;  // m
  const Drawing drawing(scene.parts);
  const std::vector<VisibleSurface> pixels = drawing.draw(camera, pose);
  const auto reference = reference_view(scene, CameraRays(camera), pose);
  int different = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto i = static_cast<std::size_t>(v * camera.width + u);
      const bool ours = pixels[i].body != kNoSurface;
      const bool theirs = reference.hits[i].triangle != RayCaster::Hit::kNone;
      if (ours == theirs && (!ours || pixels[i].triangle == reference.hits[i].triangle)) continue;
      ++different;
      Meeting a;
      Meeting b;
      if (ours) a = meet(drawing.soup, pixels[i].triangle, camera, pose, u, v);
      if (theirs) b = meet(drawing.soup, reference.hits[i].triangle, camera, pose, u, v);
      const bool edge = (ours && std::abs(a.pixels_inside) < kEdge) ||
                        (theirs && std::abs(b.pixels_inside) < kEdge);
      const bool close = ours && theirs && std::abs(a.depth - b.depth) < kDepth;
      EXPECT_TRUE(edge || close) << u << " " << v << ": " << a.depth << " and " << b.depth
                                 << " m, inside by " << a.pixels_inside << " and "
                                 << b.pixels_inside << " px";
    }
  }
  EXPECT_LT(different, 1e-3 * camera.width * camera.height);
}

TEST(Rasterizer, SeesWhatRaysMeetInAPlantRow) {
  const Scene scene = make_world(*named_world("scenario_2"), 3);
  const auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  expect_as_embree(scene, camera, look_at(Vec3(-0.12, 0.2, 0.78), Vec3(0.75, 0.2, 0.68)));
  expect_as_embree(scene, camera, look_at(Vec3(0.1, -1.0, 1.5), Vec3(-0.7, -0.8, 0.5), 0.7));
}

TEST(Rasterizer, SeesWhatRaysMeetFromAmongTheLeaves) {
  // Leaves reach behind the camera and into it.
  const Scene scene = make_world(*named_world("dense_1"), 2);
  const auto camera = CameraIntrinsics::from_fov(320, 240, kFov);
  Rng rng(5, "poses");
  const Box plants = scene.bounds(true);
  for (int i = 0; i < 4; ++i) {
    const Vec3 eye{rng.uniform(0.4, 0.9), rng.uniform(-1.0, 1.0), rng.uniform(0.3, 1.8)};
    const Vec3 aim{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(0.2, 2.0)};
    expect_as_embree(scene, camera, look_at(eye, aim, rng.uniform(-3.0, 3.0)));
  }
  EXPECT_LT(plants.min().x(), 0.0);
}

TEST(Rasterizer, KeepsToOddCamerasAndFarOffWorlds) {
  Scene scene = make_world(*named_world("scenario_1"), 5);
  const Vec3 far(-40.0, 55.0, 3.0);
  for (ScenePart& part : scene.parts) {
    for (auto& p : part.mesh.vertices) p += far.cast<float>();
  }
  CameraIntrinsics camera{173, 211, 190.0, 260.0, 40.25, 171.75};
  expect_as_embree(scene, camera,
                   look_at(Vec3(-0.1, 0.3, 0.8) + far, Vec3(0.75, 0.4, 0.5) + far, 0.3));
}

/// A sphere around the origin in triangles of all shapes, inside out.
ScenePart shell(double radius, int parallels, int meridians) {
  ScenePart part;
  for (int i = 0; i <= parallels; ++i) {
    for (int k = 0; k < meridians; ++k) {
      const double polar = std::numbers::pi * i / parallels;
      const double azimuth = 2.0 * std::numbers::pi * k / meridians;
      part.mesh.vertices.emplace_back(
          (radius * Vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                         std::cos(polar)))
              .cast<float>());
    }
  }
  const auto at = [&](int i, int k) {
    return static_cast<std::uint32_t>(i * meridians + k % meridians);
  };
  for (int i = 0; i < parallels; ++i) {
    for (int k = 0; k < meridians; ++k) {
      part.mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      part.mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return part;
}

TEST(Rasterizer, LeavesNoGapBetweenNeighbours) {
  const auto camera = CameraIntrinsics::from_fov(200, 150, kFov);
  Rng rng(7, "shells");
  for (const auto& [parallels, meridians] :
       {std::pair{2, 3}, std::pair{9, 7}, std::pair{40, 300}, std::pair{300, 20}}) {
    const Drawing drawing({shell(2.0, parallels, meridians)});
    for (int i = 0; i < 10; ++i) {
      const Vec3 eye{rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)};
      const Vec3 aim{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)};
      const auto pixels = drawing.draw(camera, look_at(eye, aim, rng.uniform(-3.0, 3.0)));
      for (std::size_t p = 0; p < pixels.size(); ++p) {
        ASSERT_NE(pixels[p].body, kNoSurface)
            << parallels << " × " << meridians << ", view " << i << ", pixel " << p;
      }
    }
  }
}

TEST(Rasterizer, DrawsTheSameAtEveryLevelAndWithAnyNumberOfThreads) {
  const Drawing drawing(make_world(*named_world("dense_1"), 4).parts);
  CameraIntrinsics camera{331, 247, 200.0, 210.0, 170.5, 120.25};
  for (const double x : {-0.1, 0.6}) {  // in the aisle, and among leaves
    const Pose pose = look_at(Vec3(x, 0.3, 1.1), Vec3(0.8, -0.2, 0.9), 0.2);
    const auto expected = drawing.draw(camera, pose, SimdLevel::scalar);
    for (const SimdLevel level : kSimdLevels) {
      if (level > best_simd_level()) continue;
      for (const int threads : {1, 2}) {
        std::vector<VisibleSurface> pixels;
        oneapi::tbb::task_arena(threads).execute(
            [&] { pixels = drawing.draw(camera, pose, level); });
        ASSERT_TRUE(pixels == expected) << simd_level_name(level) << ", " << threads;
      }
    }
  }
}

TEST(Rasterizer, DrawsNothingOfNothing) {
  const auto camera = CameraIntrinsics::from_fov(1, 1, kFov);
  const Drawing drawing({});
  const auto pixels = drawing.draw(camera, look_at(Vec3(0, 0, 0), Vec3(1, 0, 0)));
  ASSERT_EQ(pixels.size(), 1U);
  EXPECT_EQ(pixels[0].body, kNoSurface);
}

TEST(TriangleClusters, HoldEveryTriangleOnceAndInItsBox) {
  const SurfaceSoup soup = make_surface_soup(make_world(*named_world("scenario_1"), 1).parts);
  const TriangleClusters clusters = make_triangle_clusters(soup);
  std::vector<int> seen(soup.triangles.size(), 0);
  for (const TriangleClusters::Cluster& c : clusters.clusters) {
    ASSERT_LE(c.triangles, TriangleClusters::kMaxTriangles);
    ASSERT_EQ(c.vertices % TriangleClusters::kPadding, 0U);
    for (std::uint32_t t = c.first_triangle; t < c.first_triangle + c.triangles; ++t) {
      const SurfaceSoup::Triangle& triangle = soup.triangles[clusters.triangles[t]];
      ++seen[clusters.triangles[t]];
      EXPECT_EQ(triangle.part, soup.triangles[clusters.triangles[c.first_triangle]].part);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = c.first_vertex + clusters.corners[t][k];
        const Eigen::Vector3f p(clusters.x[at], clusters.y[at], clusters.z[at]);
        EXPECT_EQ(p, soup.vertices[triangle.vertex[k]]);
        EXPECT_TRUE(((p - c.centre).cwiseAbs().array() <= c.half.array()).all());
      }
    }
  }
  for (const int times : seen) ASSERT_EQ(times, 1);
  // Most groups are full.
  EXPECT_LT(clusters.clusters.size(), soup.triangles.size() / 40);
}

TEST(DepthTiles, HideWhatIsBehindAllPixelsOfABox) {
  DepthTiles tiles(20, 12);  // not whole tiles
  const PixelBox all{0, 19, 0, 11};
  EXPECT_FALSE(tiles.hidden(all, 0.1F));
  for (int v = 0; v < 12; ++v) {
    for (std::size_t u = 0; u < 20; ++u) {
      tiles.nearness()[static_cast<std::size_t>(v) * tiles.stride() + u] = 1.0F;
    }
  }
  EXPECT_FALSE(tiles.hidden(all, 0.9F));  // nobody told it
  tiles.drawn(all);
  EXPECT_TRUE(tiles.hidden(all, 0.9F));
  EXPECT_FALSE(tiles.hidden(all, 1.0F));  // not nearer
  EXPECT_FALSE(tiles.hidden({9, 10, 2, 3}, 1.5F));
}

}  // namespace
}  // namespace canopeer
