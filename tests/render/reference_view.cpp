#include "reference_view.h"

#include <algorithm>
#include <cmath>

namespace canopeer::testing_support {
namespace {

constexpr float kDirect = 1.4F;

struct Finish {
  float gloss = 0.0F;
  int exponent = 1;
  float translucency = 0.0F;
};

Finish finish_of(PartClass kind) {
  if (kind == PartClass::leaf) return {14.0F, 8, 0.45F};
  if (kind == PartClass::fruit) return {110.0F, 32, 0.0F};
  if (kind == PartClass::stem || kind == PartClass::calyx) return {8.0F, 8, 0.0F};
  return {};
}

float lattice_noise(std::int32_t i, std::int32_t j) {
  auto h =
      static_cast<std::uint32_t>(i) * 0x9e3779b1U + static_cast<std::uint32_t>(j) * 0x85ebca77U;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1.0p-23F - 1.0F;
}

float blotches(float x, float y, float cells_per_m) {
  x *= cells_per_m;
  y *= cells_per_m;
  const float s = x - std::floor(x);
  const float t = y - std::floor(y);
  const auto a = static_cast<std::int32_t>(std::floor(x));
  const auto b = static_cast<std::int32_t>(std::floor(y));
  return (1.0F - t) * ((1.0F - s) * lattice_noise(a, b) + s * lattice_noise(a + 1, b)) +
         t * ((1.0F - s) * lattice_noise(a, b + 1) + s * lattice_noise(a + 1, b + 1));
}

Eigen::Vector3f shade(const SurfaceSoup& soup, const RayCaster::Hit& hit, const RayCaster::Ray& ray,
                      const Eigen::Vector3f& to_light, float ambient, bool shadowed) {
  const SurfaceSoup::Triangle& triangle = soup.triangles[hit.triangle];
  const PartClass kind = soup.parts[triangle.part].kind;
  const SurfaceSoup::Finish& a = soup.finish[triangle.vertex[0]];
  const SurfaceSoup::Finish& b = soup.finish[triangle.vertex[1]];
  const SurfaceSoup::Finish& c = soup.finish[triangle.vertex[2]];
  const float w = 1.0F - hit.u - hit.v;
  Eigen::Vector3f n = (w * a.normal + hit.u * b.normal + hit.v * c.normal).normalized();
  if (n.dot(ray.direction) > 0.0F) n = -n;
  float even = w * a.brightness + hit.u * b.brightness + hit.v * c.brightness;
  if (kind == PartClass::structure && n.z() > 0.5F) {
    const Eigen::Vector3f p = ray.origin + hit.distance * ray.direction;
    even = 1.0F + 0.05F * blotches(p.x(), p.y(), 66.0F) + 0.05F * blotches(p.x(), p.y(), 9.0F);
  }
  const Finish finish = finish_of(kind);
  const float facing = n.dot(to_light);
  const float direct = shadowed ? 0.0F : 1.0F - ambient;
  const float sky = ambient * (0.85F + 0.35F * n.z());
  const Eigen::Vector3f base = base_color(soup, hit.triangle, {hit.u, hit.v});
  Eigen::Vector3f color = base * (even * (sky + kDirect * direct * std::max(facing, 0.0F)));
  const float through = std::max(-facing, 0.0F) * finish.translucency * kDirect * direct * even;
  color += through * base.cwiseProduct(Eigen::Vector3f(1.1F, 1.25F, 0.7F));
  if (facing > 0.0F && !shadowed) {
    const Eigen::Vector3f half = (to_light - ray.direction.normalized()).normalized();
    color.array() +=
        finish.gloss * std::pow(std::max(n.dot(half), 0.0F), static_cast<float>(finish.exponent));
  }
  return color;
}

Eigen::Vector3f sky_color(const Eigen::Vector3f& direction) {
  const float height = std::clamp(direction.normalized().z(), 0.0F, 1.0F);
  return (1.0F - height) * Eigen::Vector3f(222.0F, 228.0F, 232.0F) +
         height * Eigen::Vector3f(176.0F, 200.0F, 222.0F);
}

}  // namespace

ReferenceView reference_view(const Scene& scene, const CameraRays& rays, const Pose& T_world_camera,
                             const RenderOptions& options) {
  const SurfaceSoup soup = make_surface_soup(scene.parts);
  const RayCaster caster(soup);
  const Eigen::Vector3f to_light = options.light_direction.normalized().cast<float>();
  ReferenceView view;
  for (int v = 0; v < rays.intrinsics().height; ++v) {
    for (int u = 0; u < rays.intrinsics().width; ++u) {
      const RayCaster::Ray ray{T_world_camera.translation().cast<float>(),
                               (T_world_camera.linear() * rays.ray(u, v)).cast<float>()};
      RayCaster::Hit hit;
      caster.closest(std::span(&ray, 1), std::span(&hit, 1));
      view.hits.push_back(hit);
      if (hit.triangle == RayCaster::Hit::kNone) {
        view.colors.push_back(sky_color(ray.direction));
        continue;
      }
      bool shadowed = false;
      if (options.shadows) {
        const RayCaster::Ray to{ray.origin + hit.distance * ray.direction, to_light};
        caster.occluded(std::span(&to, 1), 1e-3F, std::span(&shadowed, 1));
      }
      view.colors.push_back(
          shade(soup, hit, ray, to_light, static_cast<float>(options.ambient), shadowed));
    }
  }
  return view;
}

}  // namespace canopeer::testing_support
