#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// Writes a scene as binary glTF 2.0 that any viewer shows and read_mesh_file() reads back: a node
/// a plant ("plant_3", or the model's name where its fruits tell it) and one for what belongs to
/// none, below them a node a part. Materials are called by class: "fruit_counted", "fruit", "leaf",
/// "stem", "structure" …, so that patterns are easy to give. Textures lie in the file.
[[nodiscard]] Expected<void> write_scene_glb(const std::filesystem::path& path, const Scene& scene);

}  // namespace canopeer
