#include "canopeer/render/shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace canopeer {
namespace {

constexpr float kDirect = 1.4F;  // brightness of a surface square to the light, without ambient

/// How a material answers light.
struct Finish {
  float gloss = 0.0F;      ///< strength of the highlight, grey levels
  int sharpness = 0;       ///< its exponent is 2^sharpness
  float translucency = 0;  ///< share of light from behind that comes through
};

Finish finish_of(PartClass kind) {
  switch (kind) {
    case PartClass::leaf:
      return {14.0F, 3, 0.45F};
    case PartClass::fruit:
      return {110.0F, 5, 0.0F};
    case PartClass::stem:
    case PartClass::calyx:
      return {8.0F, 3, 0.0F};
    default:
      return {};
  }
}

float power_of_two_exponent(float x, int doublings) {
  for (int i = 0; i < doublings; ++i) x *= x;
  return x;
}

/// −1 … 1 at a point of the integer grid.
float lattice_noise(std::int32_t i, std::int32_t j) {
  auto h =
      static_cast<std::uint32_t>(i) * 0x9e3779b1U + static_cast<std::uint32_t>(j) * 0x85ebca77U;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1.0p-23F - 1.0F;
}

/// Blotches on the ground: value noise over x and y, −1 … 1.
float blotches(float x, float y, float cells_per_m) {
  x *= cells_per_m;
  y *= cells_per_m;
  const float i = std::floor(x);
  const float j = std::floor(y);
  const float s = x - i;
  const float t = y - j;
  const auto a = static_cast<std::int32_t>(i);
  const auto b = static_cast<std::int32_t>(j);
  return (1.0F - t) * ((1.0F - s) * lattice_noise(a, b) + s * lattice_noise(a + 1, b)) +
         t * ((1.0F - s) * lattice_noise(a, b + 1) + s * lattice_noise(a + 1, b + 1));
}

}  // namespace

Eigen::Vector3f shade(const SurfaceSoup& soup, const RayCaster::Hit& hit, const RayCaster::Ray& ray,
                      const Light& light, bool shadowed) {
  const SurfaceSoup::Triangle& triangle = soup.triangles[hit.triangle];
  const SurfaceSoup::Part& part = soup.parts[triangle.part];
  const SurfaceSoup::Finish& a = soup.finish[triangle.vertex[0]];
  const SurfaceSoup::Finish& b = soup.finish[triangle.vertex[1]];
  const SurfaceSoup::Finish& c = soup.finish[triangle.vertex[2]];
  const Finish finish = finish_of(part.kind);
  const float w = 1.0F - hit.u - hit.v;
  Eigen::Vector3f n = (w * a.normal + hit.u * b.normal + hit.v * c.normal).normalized();
  if (n.dot(ray.direction) > 0.0F) n = -n;  // towards the viewer

  float even = w * a.brightness + hit.u * b.brightness + hit.v * c.brightness;
  if (part.kind == PartClass::structure && n.z() > 0.5F) {
    const Eigen::Vector3f p = ray.origin + hit.distance * ray.direction;
    even = 1.0F + 0.05F * blotches(p.x(), p.y(), 66.0F) + 0.05F * blotches(p.x(), p.y(), 9.0F);
  }
  const float facing = n.dot(light.direction);
  const float direct = shadowed ? 0.0F : 1.0F - light.ambient;
  const float sky = light.ambient * (0.85F + 0.35F * n.z());  // more comes from above
  const Eigen::Vector3f base = base_color(soup, hit.triangle, {hit.u, hit.v});
  Eigen::Vector3f color = base * (even * (sky + kDirect * direct * std::max(facing, 0.0F)));
  if (finish.translucency > 0.0F && facing < 0.0F) {
    const float through = -facing * finish.translucency * kDirect * direct * even;
    color += through * base.cwiseProduct(Eigen::Vector3f(1.1F, 1.25F, 0.7F));
  }
  if (finish.gloss > 0.0F && facing > 0.0F && !shadowed) {
    const Eigen::Vector3f half = (light.direction - ray.direction.normalized()).normalized();
    const float highlight = power_of_two_exponent(std::max(n.dot(half), 0.0F), finish.sharpness);
    color.array() += finish.gloss * highlight;
  }
  return color;
}

Eigen::Vector3f sky_color(const Eigen::Vector3f& direction) {
  const float height = std::clamp(direction.normalized().z(), 0.0F, 1.0F);
  return (1.0F - height) * Eigen::Vector3f(222.0F, 228.0F, 232.0F) +
         height * Eigen::Vector3f(176.0F, 200.0F, 222.0F);
}

}  // namespace canopeer
