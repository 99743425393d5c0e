#pragma once

#include <string>

#include "canopeer/import/meshes/file_mesh.h"

struct aiMaterial;

namespace canopeer {

/// What colours mean differs between formats: glTF's material colours are linear and multiply
/// vertex colours; viewers of COLLADA show no vertex colours.
enum class MaterialDialect { plain, collada, gltf };

/// Colours, references to pictures and opacity of one of assimp's materials.
[[nodiscard]] FileMaterial read_file_material(const aiMaterial& material, MaterialDialect dialect);

/// A sentence for the user when a COLLADA material may be clear or not; empty when all is plain.
[[nodiscard]] std::string opacity_in_doubt(const aiMaterial& material, MaterialDialect dialect);

}  // namespace canopeer
