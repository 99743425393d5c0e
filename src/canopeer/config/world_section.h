#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/import/world_source.h"

namespace canopeer {

/// Reads the `world:` section of a mission: a generated world (preset, plants, rows, furniture),
/// one that is there already (`import:`), or one described in a scene file (`scene:`). Complaints
/// go to `world`; an error of a further file comes back.
[[nodiscard]] Expected<void> read_world(YamlMap world, WorldSource& source);

/// Reads a scene file: the keys of a mission's `world:` section at its top, and `seed`.
struct SceneFile {
  WorldSource world;
  std::uint64_t seed = 1;
};
[[nodiscard]] Expected<SceneFile> load_scene_file(const std::filesystem::path& path);

/// Whether a YAML file describes a scene and no mission: it names no robot.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& path);

}  // namespace canopeer
