#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/import/world_source.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/mission/registries.h"
#include "canopeer/sim/simulation.h"

namespace canopeer {

/// All that a mission file says; keys and defaults are in docs/formats.md.
struct MissionFile {
  MissionOptions mission;
  std::filesystem::path robot;  ///< robot.yaml
  WorldSource world;
  SimulationOptions simulation;
  std::optional<Ros2Settings> ros2;       ///< of the site of that name; none: its defaults
  std::optional<Pose> T_frame_camera;     ///< camera mounting in place of the robot file's
  std::string compute_table = "default";  ///< name or file of the cost table
  std::string settings_json;              ///< every key with the value in force, defaults too
};

/// Settings from the command line that come before those of the file: dotted key and YAML value.
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Reads a mission and its cost table. `table_dirs`: where tables given by name are looked for;
/// `registries`: the planners and detectors that may be named. The error has file, line and key.
[[nodiscard]] Expected<MissionFile> load_mission(
    const std::filesystem::path& path, const Overrides& overrides,
    const std::vector<std::filesystem::path>& table_dirs,
    const Registries& registries = Registries::built_in());

}  // namespace canopeer
