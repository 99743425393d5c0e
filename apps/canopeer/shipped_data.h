#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace canopeer::app {

/// The folder of robots, missions, worlds and compute tables that come with the program: what the
/// environment variable CANOPEER_DATA names; else ../share/canopeer as seen from the program's own
/// folder; else, for programs that stand elsewhere, where the library was to be installed.
[[nodiscard]] std::filesystem::path shipped_data();

/// The user's own folder, of what this machine has measured: $XDG_DATA_HOME/canopeer, or
/// ~/.local/share/canopeer; empty without a home. It need not exist.
[[nodiscard]] std::filesystem::path own_data();

/// Names of the missions in it, sorted: "scenario_1", …
[[nodiscard]] std::vector<std::string> shipped_missions();

/// The file that is meant: the one given or, where there is none, the shipped mission of that name.
/// Ends the command when a bare name is neither.
[[nodiscard]] std::filesystem::path mission_file_of(const std::string& given);

}  // namespace canopeer::app
