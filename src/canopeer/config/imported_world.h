#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/import/world_source.h"

namespace canopeer {

/// Reads the `world:` section of a mission that has `import:`, a world or mesh file, or a scene
/// file of scanned plants (.yaml); keys are in docs/formats.md, paths relative to the mission file.
/// Complaints go to `world`; an error of the scene file comes back.
[[nodiscard]] Expected<void> read_imported_world(YamlMap& world, WorldSource& source);

/// Name patterns and sizes of fruits; shared with scene files.
void read_name_patterns(YamlMap& map, NamePatternOptions& options);
void read_fruit_sizes(YamlMap& map, FruitComponentOptions& options);

}  // namespace canopeer
