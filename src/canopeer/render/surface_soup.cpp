#include "canopeer/render/surface_soup.h"

#include "canopeer/base/check.h"
#include "canopeer/render/pixel_hash.h"

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

}  // namespace

SurfaceSoup make_surface_soup(const Scene& scene) {
  SurfaceSoup soup;
  for (const ScenePart& part : scene.parts) {
    const auto part_index = static_cast<std::uint32_t>(soup.parts.size());
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    TriangleMesh mesh = part.mesh;
    if (mesh.normals.empty()) compute_normals(mesh);
    CANOPEER_CHECK(mesh.normals.size() == mesh.vertices.size(), "one normal per vertex");
    soup.parts.push_back({Eigen::Vector3f(part.color.r, part.color.g, part.color.b), part.kind,
                          static_cast<std::int16_t>(part.fruit)});
    soup.vertices.insert(soup.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    soup.normals.insert(soup.normals.end(), mesh.normals.begin(), mesh.normals.end());
    const float spread = brightness_spread(part.kind);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const auto bits = static_cast<std::uint32_t>(pixel_hash(first + i) >> 40);  // 24 bits
      const float share = static_cast<float>(bits) * 0x1.0p-23F - 1.0F;           // −1 … 1
      soup.brightness.push_back(1.0F + spread * share);
    }
    for (const auto& t : mesh.triangles) {
      soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
      soup.part_of.push_back(part_index);
    }
  }
  return soup;
}

}  // namespace canopeer
