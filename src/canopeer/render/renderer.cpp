#include "canopeer/render/renderer.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/render/pixel_hash.h"
#include "canopeer/render/ray_caster.h"
#include "canopeer/render/shading.h"

namespace canopeer {
namespace {

constexpr int kBlock = 8;  // pixels a side: one packet of rays
static_assert(kBlock * kBlock == RayCaster::kPacket);

/// What all pixels of a view share.
struct View {
  const CameraRays& rays;
  const CameraIntrinsics& camera;
  Eigen::Vector3f origin;
  Eigen::Matrix3d R_world_camera;
  std::uint64_t noise_key;
};

/// One block of pixels, cut off at the image's border.
struct Block {
  std::array<RayCaster::Ray, RayCaster::kPacket> rays;
  std::array<RayCaster::Hit, RayCaster::kPacket> hits;
  std::array<bool, RayCaster::kPacket> shadowed{};
  std::array<std::array<int, 2>, RayCaster::kPacket> pixels;
  std::size_t count = 0;
};

std::uint64_t key_of(std::uint64_t seed, const Pose& pose) {
  std::uint64_t key = pixel_hash(seed);
  for (int i = 0; i < 16; ++i) key = pixel_hash(key ^ std::bit_cast<std::uint64_t>(pose.data()[i]));
  return key;
}

Block make_block(const View& view, int u0, int v0) {
  Block block;
  for (int v = v0; v < std::min(v0 + kBlock, view.camera.height); ++v) {
    for (int u = u0; u < std::min(u0 + kBlock, view.camera.width); ++u) {
      // The direction's component along the optical axis is 1: distances are depths.
      const Vec3 direction = view.R_world_camera * view.rays.ray(u, v);
      block.rays[block.count] = {view.origin, direction.cast<float>()};
      block.pixels[block.count++] = {u, v};
    }
  }
  return block;
}

/// Triangular noise in −1 … 1 from 16 bits.
float triangular(std::uint64_t bits) {
  return (static_cast<float>(bits & 0xff) + static_cast<float>((bits >> 8) & 0xff)) / 255.0F - 1.0F;
}

Rgb to_rgb(const Eigen::Vector3f& color, float noise, std::uint64_t bits) {
  std::array<std::uint8_t, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    const float x = color[static_cast<Eigen::Index>(i)] + noise * triangular(bits >> (16 * i));
    c[i] = static_cast<std::uint8_t>(std::clamp(x, 0.0F, 255.0F) + 0.5F);
  }
  return {c[0], c[1], c[2]};
}

/// Nothing outside the sensor's range.
float in_range(float depth, const CameraIntrinsics& camera) {
  return depth >= camera.min_range_m && depth <= camera.max_range_m ? depth : 0.0F;
}

std::vector<SurfaceSoup> make_models(const Scene& scene) {
  std::vector<SurfaceSoup> models;
  for (const SceneModel& model : scene.models) models.push_back(make_surface_soup(model.parts));
  return models;
}

std::vector<RayCaster::Placement> placements_of(const Scene& scene) {
  std::vector<RayCaster::Placement> placements;
  for (const SceneInstance& i : scene.instances) placements.push_back({i.model, i.T_world_model});
  return placements;
}

}  // namespace

struct Renderer::Impl {
  Impl(const Scene& scene, const RenderOptions& o)
      : options(o),
        world(make_surface_soup(scene.parts)),
        models(make_models(scene)),
        caster(world, models, placements_of(scene)),
        light{o.light_direction.normalized().cast<float>(), static_cast<float>(o.ambient)} {
    for (const SceneInstance& instance : scene.instances) {
      copies.push_back({&models[instance.model],
                        instance.T_world_model.linear().transpose().cast<float>(),
                        instance.brightness, static_cast<std::int16_t>(instance.first_fruit)});
    }
  }

  void cast_shadows(Block* block) const;
  void render_block(const View& view, int u0, int v0, RenderedView* out) const;

  RenderOptions options;
  /// A model in its place: shading is done in its frame.
  struct Copy {
    const SurfaceSoup* soup;
    Eigen::Matrix3f R_model_world;
    float brightness;
    std::int16_t first_fruit;
  };

  void shade_pixel(const Block& block, std::size_t i, std::uint64_t bits, const View& view,
                   RenderedView* out) const;

  SurfaceSoup world;
  std::vector<SurfaceSoup> models;
  RayCaster caster;
  std::vector<Copy> copies;
  Light light;
};

void Renderer::Impl::cast_shadows(Block* block) const {
  std::array<RayCaster::Ray, RayCaster::kPacket> to_light;
  for (std::size_t i = 0; i < block->count; ++i) {
    const auto& ray = block->rays[i];
    to_light[i] = {ray.origin + block->hits[i].distance * ray.direction, light.direction};
  }
  constexpr float kOffSurface = 1e-3F;
  caster.occluded(std::span(to_light).first(block->count), kOffSurface,
                  std::span(block->shadowed).first(block->count));
}

void Renderer::Impl::render_block(const View& view, int u0, int v0, RenderedView* out) const {
  Block block = make_block(view, u0, v0);
  caster.closest(std::span(block.rays).first(block.count),
                 std::span(block.hits).first(block.count));
  if (options.shadows) cast_shadows(&block);
  const auto noise = static_cast<float>(options.color_noise);
  for (std::size_t i = 0; i < block.count; ++i) {
    const auto [u, v] = block.pixels[i];
    const RayCaster::Hit& hit = block.hits[i];
    const std::uint64_t bits = pixel_hash(view.noise_key + static_cast<std::uint64_t>(v) * 65536U +
                                          static_cast<std::uint64_t>(u));
    if (hit.triangle == RayCaster::Hit::kNone) {
      out->color.at(u, v) = to_rgb(sky_color(block.rays[i].direction), noise, bits);
      continue;
    }
    shade_pixel(block, i, bits, view, out);
  }
}

void Renderer::Impl::shade_pixel(const Block& block, std::size_t i, std::uint64_t bits,
                                 const View& view, RenderedView* out) const {
  const auto [u, v] = block.pixels[i];
  const RayCaster::Hit& hit = block.hits[i];
  const Copy* copy = hit.instance == RayCaster::Hit::kNone ? nullptr : &copies[hit.instance];
  const SurfaceSoup& soup = copy == nullptr ? world : *copy->soup;
  Eigen::Vector3f color;
  if (copy == nullptr) {
    color = shade(soup, hit, block.rays[i], light, block.shadowed[i]);
  } else {
    const RayCaster::Ray local{block.rays[i].origin, copy->R_model_world * block.rays[i].direction};
    const Light turned{copy->R_model_world * light.direction, light.ambient};
    color = copy->brightness * shade(soup, hit, local, turned, block.shadowed[i]);
  }
  const SurfaceSoup::Part& part = soup.parts[soup.triangles[hit.triangle].part];
  out->color.at(u, v) = to_rgb(color, static_cast<float>(options.color_noise), bits);
  out->depth.at(u, v) = in_range(hit.distance, view.camera);
  out->labels.kind.at(u, v) = static_cast<std::uint8_t>(part.kind);
  const bool numbered = copy != nullptr && part.fruit >= 0;
  out->labels.fruit.at(u, v) =
      static_cast<std::int16_t>(part.fruit + (numbered ? copy->first_fruit : 0));
}

Renderer::Renderer(const Scene& scene, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

RenderedView Renderer::render(const CameraRays& rays, const Pose& T_world_camera) const {
  const CameraIntrinsics& intrinsics = rays.intrinsics();
  const int width = intrinsics.width;
  const int height = intrinsics.height;
  CANOPEER_CHECK(width > 0 && height > 0, "an image has pixels");
  RenderedView out{DepthImage(width, height, 0.0F),
                   ColorImage(width, height),
                   {Image<std::int16_t>(width, height, std::int16_t{-1}),
                    Image<std::uint8_t>(width, height, Labels::kNothing)}};
  const View view{rays, intrinsics, T_world_camera.translation().cast<float>(),
                  T_world_camera.linear(), key_of(impl_->options.noise_seed, T_world_camera)};
  // Every pixel is written by one task and depends on nothing but itself.
  const int block_rows = (height + kBlock - 1) / kBlock;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, block_rows, 2),
                            [&](const oneapi::tbb::blocked_range<int>& rows) {
                              for (int row = rows.begin(); row < rows.end(); ++row) {
                                for (int u = 0; u < width; u += kBlock) {
                                  impl_->render_block(view, u, row * kBlock, &out);
                                }
                              }
                            });
  return out;
}

}  // namespace canopeer
