#pragma once

#include <filesystem>
#include <string>

namespace canopeer {

/// A glTF 2.0 file said in plain words, as binary glTF, for a library that takes half of the format
/// for granted: positions, normals and texture coordinates as floats (KHR_mesh_quantization), the
/// coordinates of the base colour in the first set and where KHR_texture_transform puts them,
/// pictures of EXT_texture_webp and the like as sources, colours of
/// KHR_materials_pbrSpecularGlossiness as base colours, all numbers in one buffer,
/// whole words. Empty: there is
/// nothing to say otherwise, so the file may be read as it is; glTF 1.0, too.
///
/// Throws std::runtime_error over an extension that the file needs and nobody here knows, over
/// packed meshes, and over what is damaged. For use in a guarded_call().
[[nodiscard]] std::string plain_gltf(const std::filesystem::path& path);

}  // namespace canopeer
