#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace canopeer {

/// A glTF file's two parts. Told apart by content: a .gltf may hold binary glTF, and the other way
/// round.
struct GltfContainer {
  std::string json;
  std::string binary;  ///< of binary glTF; else empty
  /// Whether its parts have whole words as binary glTF must; some writers forget it.
  bool aligned = true;
};

/// Whether it is binary glTF 1.0, whose parts lie otherwise.
[[nodiscard]] bool is_old_binary_gltf(std::string_view bytes);

/// Throws std::runtime_error over lengths that do not fit.
[[nodiscard]] GltfContainer read_gltf_container(std::string_view bytes);

/// Binary glTF 2.0 of the two parts.
[[nodiscard]] std::string to_glb(const GltfContainer& container);

/// The bytes that the address of a buffer stands for: "data:…;base64,…", or a file beside the one
/// in `folder`, percent-encoded or not. Throws std::runtime_error when there are none.
[[nodiscard]] std::string bytes_behind(const std::string& uri, const std::filesystem::path& folder);

}  // namespace canopeer
