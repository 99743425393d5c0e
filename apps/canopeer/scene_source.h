#pragma once

#include <optional>

#include "canopeer/config/mission_file.h"
#include "commands.h"

namespace canopeer::app {

/// A world to look at: that of a mission, or of a scene file.
struct SceneSource {
  WorldSource world;
  std::uint64_t seed = 1;
  std::optional<MissionFile> mission;  ///< none: it was a scene file
};

/// Reads either; ends the command when something is wrong.
[[nodiscard]] SceneSource load_scene_source(const MissionArguments& arguments);

}  // namespace canopeer::app
