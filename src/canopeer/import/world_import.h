#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/assembly/name_patterns.h"
#include "canopeer/import/assembly/scene_assembly.h"

namespace canopeer {

/// A world somebody has, and what is what in it.
struct WorldImportOptions {
  std::filesystem::path file;  ///< .world or .sdf, or a mesh file; empty: nothing to import
  std::vector<std::filesystem::path> model_paths;  ///< for model:// and package://
  /// Where programs of Gazebo keep models they fetched, for https:// ("~/.gz/fuel").
  std::vector<std::filesystem::path> fuel_caches;
  NamePatternOptions patterns;
  FruitComponentOptions fruits;
  /// COLLADA's `<up_axis>`: true follows it, false takes coordinates as they are, as Gazebo does.
  bool honour_up_axis = true;
};

/// How far a long import is.
struct ImportProgress {
  std::size_t done = 0;  ///< of `total` shapes or plants
  std::size_t total = 0;
  std::size_t triangles = 0;  ///< so far
};
using ImportProgressCallback = std::function<void(const ImportProgress&)>;

/// Reads a world or a mesh with all it refers to, and makes a scene of it. The connected components
/// of the fruit surfaces are its ground truth. Each mesh and texture file is read once. Errors name
/// the file, the element and what was expected. What can be done without becomes a notice.
[[nodiscard]] Expected<ImportedScene> import_world(const WorldImportOptions& options,
                                                   const ImportProgressCallback& progress = {});

}  // namespace canopeer
