#include "canopeer/render/surfaces/surface_soup.h"

#include "canopeer/base/check.h"
#include "canopeer/render/surfaces/pixel_hash.h"

namespace canopeer {
namespace {

float brightness_spread(PartClass kind) {
  switch (kind) {
    case PartClass::leaf:
      return 0.10F;
    case PartClass::fruit:
      return 0.05F;
    case PartClass::structure:
      return 0.0F;
    default:
      return 0.07F;
  }
}

Eigen::Vector3f to_vector(Rgb c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

bool textured(const ScenePart& part) {
  return part.texture != nullptr && part.uv.size() == part.mesh.vertices.size();
}

/// Texture coordinates and vertex colours, once any part has them.
void add_paint(const ScenePart& part, std::size_t first, SurfaceSoup* soup) {
  if (textured(part)) {
    soup->uv.resize(first, Eigen::Vector2f::Zero());
    soup->uv.insert(soup->uv.end(), part.uv.begin(), part.uv.end());
    soup->parts.back().texture = part.texture;
  }
  if (part.vertex_colors.size() == part.mesh.vertices.size() && !part.vertex_colors.empty()) {
    soup->colors.resize(first, Eigen::Vector3f::Zero());
    for (const Rgb& c : part.vertex_colors) soup->colors.push_back(to_vector(c));
    soup->parts.back().vertex_colors = true;
  }
}

void add_part(const ScenePart& part, SurfaceSoup* soup) {
  const auto part_index = static_cast<std::uint32_t>(soup->parts.size());
  const auto first = static_cast<std::uint32_t>(soup->vertices.size());
  TriangleMesh mesh = part.mesh;
  if (mesh.normals.empty()) compute_normals(mesh);
  CANOPEER_CHECK(mesh.normals.size() == mesh.vertices.size(), "one normal per vertex");
  soup->parts.push_back(
      {to_vector(part.color), part.kind, static_cast<std::int16_t>(part.fruit), nullptr, false});
  add_paint(part, first, soup);
  soup->vertices.insert(soup->vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  // A picture or a scan has shades of its own.
  const bool painted = soup->parts.back().texture != nullptr || soup->parts.back().vertex_colors;
  const float spread = painted ? 0.0F : brightness_spread(part.kind);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto bits = static_cast<std::uint32_t>(pixel_hash(first + i) >> 40);  // 24 bits
    const float share = static_cast<float>(bits) * 0x1.0p-23F - 1.0F;           // −1 … 1
    soup->finish.push_back({mesh.normals[i], 1.0F + spread * share});
  }
  for (const auto& t : mesh.triangles) {
    soup->triangles.push_back({{t[0] + first, t[1] + first, t[2] + first}, part_index});
  }
}

Eigen::Vector2f uv_at(const SurfaceSoup& soup, std::uint32_t triangle, Barycentric at) {
  const auto& t = soup.triangles[triangle].vertex;
  return (1.0F - at.u - at.v) * soup.uv[t[0]] + at.u * soup.uv[t[1]] + at.v * soup.uv[t[2]];
}

}  // namespace

bool has_holes(const ScenePart& part) { return textured(part) && part.texture->cuts(); }

SurfaceSoup make_surface_soup(const std::vector<ScenePart>& parts) {
  SurfaceSoup soup;
  for (const ScenePart& part : parts) {
    if (!part.see_through && !has_holes(part)) add_part(part, &soup);
  }
  soup.first_cut = static_cast<std::uint32_t>(soup.triangles.size());
  for (const ScenePart& part : parts) {
    if (!part.see_through && has_holes(part)) add_part(part, &soup);
  }
  if (!soup.uv.empty()) soup.uv.resize(soup.vertices.size(), Eigen::Vector2f::Zero());
  if (!soup.colors.empty()) soup.colors.resize(soup.vertices.size(), Eigen::Vector3f::Zero());
  return soup;
}

Eigen::Vector3f base_color(const SurfaceSoup& soup, std::uint32_t triangle, Barycentric at) {
  const SurfaceSoup::Part& part = soup.parts[soup.triangles[triangle].part];
  if (part.texture != nullptr && !part.texture->color.empty()) {
    return part.texture->color_at(uv_at(soup, triangle, at));
  }
  if (!part.vertex_colors) return part.color;
  const auto& t = soup.triangles[triangle].vertex;
  return (1.0F - at.u - at.v) * soup.colors[t[0]] + at.u * soup.colors[t[1]] +
         at.v * soup.colors[t[2]];
}

bool solid(const SurfaceSoup& soup, std::uint32_t triangle, Barycentric at) {
  const SurfaceSoup::Part& part = soup.parts[soup.triangles[triangle].part];
  return part.texture == nullptr || part.texture->solid_at(uv_at(soup, triangle, at));
}

}  // namespace canopeer
