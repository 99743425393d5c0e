#include "canopeer/scene/flat_faces.h"

namespace canopeer {

TriangleMesh with_flat_faces(const TriangleMesh& mesh) {
  TriangleMesh flat;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(flat.vertices.size());
    for (const auto i : t) flat.vertices.push_back(mesh.vertices[i]);
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  compute_normals(flat);
  return flat;
}

}  // namespace canopeer
