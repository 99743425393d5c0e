#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "canopeer/config/mission_file.h"
#include "exit_status.h"

namespace canopeer::app {

/// What several commands take to name a mission and change its settings.
struct MissionArguments {
  std::string path;
  std::vector<std::string> settings;  ///< "key=value"

  void add_to(CLI::App& command) {
    command.add_option("mission", path, "Mission file (YAML)")->required();
    command.add_option("--set", settings, "Override a setting: dotted.key=value (again for more)")
        ->take_all();
  }

  /// The mission with the settings and `extra` ones on top; ends the command when something is
  /// wrong.
  [[nodiscard]] MissionFile load(Overrides extra = {}) const {
    Overrides overrides;
    for (const auto& setting : settings) {
      const auto equals = setting.find('=');
      if (equals == std::string::npos || equals == 0) {
        stop_with(kBadInput, {"--set " + setting + ": expected key=value"});
      }
      overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
    }
    overrides.insert(overrides.end(), extra.begin(), extra.end());
    const std::vector<std::filesystem::path> tables = {
        std::filesystem::path(path).parent_path() / "../compute_tables",
        std::filesystem::path(CANOPEER_DATA_DIR) / "compute_tables"};
    return value_or_stop(load_mission(path, overrides, tables), kBadInput);
  }
};

}  // namespace canopeer::app
