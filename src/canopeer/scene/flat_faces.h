#pragma once

#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

/// The same surface with vertices of its own for every triangle and their normals: sharp edges.
TriangleMesh with_flat_faces(const TriangleMesh& mesh);

}  // namespace canopeer
