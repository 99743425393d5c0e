#include "canopeer/render/renderer.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>
#include <optional>
#include <span>

#include "canopeer/base/check.h"
#include "canopeer/render/raster/rasterizer.h"
#include "canopeer/render/rays/ray_caster.h"
#include "canopeer/render/shading/row_painter.h"
#include "canopeer/render/surfaces/pixel_hash.h"

namespace canopeer {
namespace {

std::uint64_t key_of(std::uint64_t seed, const Pose& pose) {
  std::uint64_t key = pixel_hash(seed);
  for (int i = 0; i < 16; ++i) key = pixel_hash(key ^ std::bit_cast<std::uint64_t>(pose.data()[i]));
  return key;
}

std::vector<SurfaceSoup> make_models(const Scene& scene) {
  std::vector<SurfaceSoup> models;
  for (const SceneModel& model : scene.models) models.push_back(make_surface_soup(model.parts));
  return models;
}

std::vector<TriangleClusters> make_clusters(const std::vector<SurfaceSoup>& models) {
  std::vector<TriangleClusters> clusters;
  for (const SurfaceSoup& model : models) clusters.push_back(make_triangle_clusters(model));
  return clusters;
}

Light make_light(const RenderOptions& options) {
  const Eigen::Vector3f d = options.light_direction.normalized().cast<float>();
  return {d.x(), d.y(), d.z(), static_cast<float>(options.ambient)};
}

/// What all rows of a view share.
struct View {
  const CameraRays& rays;
  const Pose& T_world_camera;
  std::vector<PaintedBody> bodies;
  std::uint64_t noise_key = 0;
};

/// A ray through each pixel of a row, depth 1.
void cast_rays(const View& view, int v, const ShadingKernels& kernels, const ShadedRow& row) {
  const CameraIntrinsics& camera = view.rays.intrinsics();
  if (view.rays.lens().none()) {
    const Eigen::Vector3f first = (view.T_world_camera.linear() * camera.ray(0, v)).cast<float>();
    const Eigen::Vector3f step = (view.T_world_camera.linear().col(0) / camera.fx).cast<float>();
    kernels.rays(first.data(), step.data(), row);
    return;
  }
  for (int u = 0; u < camera.width; ++u) {
    const Eigen::Vector3f d = (view.T_world_camera.linear() * view.rays.ray(u, v)).cast<float>();
    row.ray_x[u] = d.x();
    row.ray_y[u] = d.y();
    row.ray_z[u] = d.z();
  }
}

}  // namespace

struct Renderer::Impl {
  Impl(const Scene& scene, const RenderOptions& o)
      : options(o),
        light(make_light(o)),
        world(make_surface_soup(scene.parts)),
        models(make_models(scene)),
        world_clusters(make_triangle_clusters(world)),
        model_clusters(make_clusters(models)),
        instances(scene.instances),
        rasterizer(bodies(), o.simd) {}

  [[nodiscard]] std::vector<RasterBody> bodies() const {
    std::vector<RasterBody> bodies{{&world, &world_clusters, Pose::Identity()}};
    for (const SceneInstance& i : instances) {
      bodies.push_back({&models[i.model], &model_clusters[i.model], i.T_world_model});
    }
    return bodies;
  }

  /// Needed for lenses and shadows only: made when first asked for.
  [[nodiscard]] const RayCaster& caster() const {
    std::call_once(caster_once, [&] {
      std::vector<RayCaster::Placement> places;
      for (const SceneInstance& i : instances) places.push_back({i.model, i.T_world_model});
      ray_caster = std::make_unique<RayCaster>(world, models, places);
    });
    return *ray_caster;
  }

  [[nodiscard]] View view_of(const CameraRays& rays, const Pose& T_world_camera) const;
  void trace(const View& view, const ShadedRow& row, std::vector<VisibleRun>* runs) const;
  void cast_shadows(const View& view, const ShadedRow& row) const;
  void render_row(const View& view, const VisibleImage* image, int v, RowPainter* painter,
                  RenderedView* out) const;

  RenderOptions options;
  Light light;
  SurfaceSoup world;
  std::vector<SurfaceSoup> models;
  TriangleClusters world_clusters;
  std::vector<TriangleClusters> model_clusters;
  std::vector<SceneInstance> instances;
  Rasterizer rasterizer;
  mutable std::once_flag caster_once;
  mutable std::unique_ptr<const RayCaster> ray_caster;
};

View Renderer::Impl::view_of(const CameraRays& rays, const Pose& T_world_camera) const {
  View view{rays, T_world_camera, {}, key_of(options.noise_seed, T_world_camera)};
  view.bodies.push_back(
      {&world, BodyRays(Pose::Identity(), T_world_camera), Eigen::Matrix3f::Identity(), 1.0F, 0});
  for (const SceneInstance& i : instances) {
    view.bodies.push_back({&models[i.model], BodyRays(i.T_world_model, T_world_camera),
                           i.T_world_model.linear().cast<float>(), i.brightness,
                           static_cast<std::int16_t>(i.first_fruit)});
  }
  return view;
}

/// What the rays of a row meet.
void Renderer::Impl::trace(const View& view, const ShadedRow& row,
                           std::vector<VisibleRun>* runs) const {
  runs->clear();
  const Eigen::Vector3f eye = view.T_world_camera.translation().cast<float>();
  std::array<RayCaster::Ray, RayCaster::kPacket> rays;
  std::array<RayCaster::Hit, RayCaster::kPacket> hits;
  for (std::size_t first = 0; first < row.count; first += RayCaster::kPacket) {
    const std::size_t count = std::min(row.count - first, RayCaster::kPacket);
    for (std::size_t i = 0; i < count; ++i) {
      rays[i] = {eye, {row.ray_x[first + i], row.ray_y[first + i], row.ray_z[first + i]}};
    }
    caster().closest(std::span(rays).first(count), std::span(hits).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const RayCaster::Hit& hit = hits[i];
      const auto u = static_cast<std::uint32_t>(first + i);
      runs->push_back({u, u + 1, {}});
      if (hit.triangle == RayCaster::Hit::kNone) continue;
      runs->back().surface = {hit.instance == RayCaster::Hit::kNone ? 0 : hit.instance + 1,
                              hit.triangle};
    }
  }
}

void Renderer::Impl::cast_shadows(const View& view, const ShadedRow& row) const {
  constexpr float kOffSurface = 1e-3F;
  const Eigen::Vector3f eye = view.T_world_camera.translation().cast<float>();
  std::array<RayCaster::Ray, RayCaster::kPacket> to_light;
  std::array<bool, RayCaster::kPacket> blocked{};
  for (std::size_t first = 0; first < row.count; first += RayCaster::kPacket) {
    const std::size_t count = std::min(row.count - first, RayCaster::kPacket);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t u = first + i;
      const Eigen::Vector3f ray(row.ray_x[u], row.ray_y[u], row.ray_z[u]);
      to_light[i] = {eye + row.depth[u] * ray, {light.x, light.y, light.z}};
    }
    caster().occluded(std::span(to_light).first(count), kOffSurface,
                      std::span(blocked).first(count));
    for (std::size_t i = 0; i < count; ++i) row.lit[first + i] = blocked[i] ? 0.0F : 1.0F;
  }
}

void Renderer::Impl::render_row(const View& view, const VisibleImage* image, int v,
                                RowPainter* painter, RenderedView* out) const {
  const ShadingKernels& kernels = shading_kernels(options.simd);
  const CameraIntrinsics& camera = view.rays.intrinsics();
  const ShadedRow& row = painter->row();
  cast_rays(view, v, kernels, row);
  std::vector<VisibleRun> runs;
  if (image != nullptr) {
    image->row(v, &runs);
  } else {
    trace(view, row, &runs);
  }
  painter->paint(runs, v, &out->labels.fruit.at(0, v), &out->labels.kind.at(0, v));
  kernels.orient(row);
  kernels.store_depth(row, static_cast<float>(camera.min_range_m),
                      static_cast<float>(camera.max_range_m), &out->depth.at(0, v));
  if (options.shadows) cast_shadows(view, row);
  const Eigen::Vector3f eye = view.T_world_camera.translation().cast<float>();
  for (const auto& [begin, end] : painter->structure()) kernels.blotch(eye.data(), begin, end, row);
  kernels.light(light, row);
  for (const auto& [begin, end] : painter->sky()) kernels.sky(begin, end, row);
  kernels.store_color(row, static_cast<float>(options.color_noise),
                      view.noise_key + static_cast<std::uint64_t>(v) * 65536U,
                      &out->color.at(0, v));
}

Renderer::Renderer(const Scene& scene, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

RenderedView Renderer::render(const CameraRays& rays, const Pose& T_world_camera) const {
  const CameraIntrinsics& camera = rays.intrinsics();
  CANOPEER_CHECK(camera.width > 0 && camera.height > 0, "an image has pixels");
  RenderedView out{DepthImage(camera.width, camera.height, 0.0F),
                   ColorImage(camera.width, camera.height),
                   {Image<std::int16_t>(camera.width, camera.height, std::int16_t{-1}),
                    Image<std::uint8_t>(camera.width, camera.height, Labels::kNothing)}};
  const View view = impl_->view_of(rays, T_world_camera);
  // Behind a lens straight edges are bent: such views are traced ray by ray.
  std::optional<VisibleImage> image;
  if (rays.lens().none()) image = impl_->rasterizer.draw(camera, T_world_camera);
  if (!image || impl_->options.shadows) (void)impl_->caster();  // made before the threads need it
  // Every row is written by one task and depends on nothing but itself. A painter knows the
  // triangles of the row before: it gets many rows in turn.
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, camera.height, 40),
                            [&](const oneapi::tbb::blocked_range<int>& rows) {
                              RowPainter painter(view.bodies, rays);
                              for (int v = rows.begin(); v < rows.end(); ++v) {
                                impl_->render_row(view, image ? &*image : nullptr, v, &painter,
                                                  &out);
                              }
                            });
  return out;
}

}  // namespace canopeer
