#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/surface/fruit_surface.h"

namespace canopeer {

/// Binary little-endian PLY: vertices with x y z, nx ny nz, red green blue and `fruit` (int: id, −1
/// for none), and the triangles. Point cloud readers take the vertices.
[[nodiscard]] Expected<void> write_surface_ply(const std::filesystem::path& path,
                                               const SurfaceMesh& mesh);

/// Binary glTF 2.0 with vertex colours, one node `fruit_ID` per fruit (`surface` for what belongs
/// to none), y up as glTF has it.
[[nodiscard]] Expected<void> write_surface_glb(const std::filesystem::path& path,
                                               const SurfaceMesh& mesh);

}  // namespace canopeer
