#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// A scene stored once, to be the same for ever, whatever becomes of the code that grew its plants
/// (decision 122). Vertices lie on a grid, 0.1 mm by default; everything else is kept as it is:
/// triangles, colours, textures, copies, ground truth. Normals are those that
/// compute_normals() gives; where a mesh has others they are kept to 2 × 8 bits. The layout is in
/// docs/formats.md.
struct SceneFileOptions {
  double grid_m = 1e-4;  ///< 1e-6 … 0.01
};

/// Ending of their names, with the dot.
inline constexpr std::string_view kSceneFileEnding = ".cscene";
[[nodiscard]] inline bool is_frozen_scene(const std::filesystem::path& path) {
  return path.extension() == kSceneFileEnding;
}

/// The same scene and options give the same bytes. Error: a coordinate beyond 2²² grid steps, or a
/// scene larger than files may be.
[[nodiscard]] Expected<std::string> scene_bytes(const Scene& scene, const SceneFileOptions& = {});
/// Takes any bytes; the error says what is wrong with them.
[[nodiscard]] Expected<Scene> parse_scene(std::string_view bytes);

/// The error names the file.
[[nodiscard]] Expected<void> write_scene_file(const std::filesystem::path& path, const Scene& scene,
                                              const SceneFileOptions& = {});
[[nodiscard]] Expected<Scene> read_scene_file(const std::filesystem::path& path);

}  // namespace canopeer
