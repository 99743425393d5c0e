#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// Writes a scene as binary glTF 2.0. Any viewer shows it, and read_mesh_file() reads it back. Each
/// plant is a node ("plant_3", or the model's name where its fruits tell it); one more holds what
/// belongs to none. Each part is a node below them. Materials are called by class: "fruit_counted",
/// "fruit", "leaf", "stem", "structure" …, so that patterns are easy to give. Textures lie in the
/// file.
[[nodiscard]] Expected<void> write_scene_glb(const std::filesystem::path& path, const Scene& scene);

}  // namespace canopeer
