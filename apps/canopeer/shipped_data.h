#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace canopeer::app {

/// The folder of robots, missions, worlds and compute tables that come with the program.
[[nodiscard]] std::filesystem::path shipped_data();

/// Names of the missions in it, sorted: "scenario_1", …
[[nodiscard]] std::vector<std::string> shipped_missions();

/// The file that is meant: the one given or, where there is none, the shipped mission of that name.
/// Ends the command when a bare name is neither.
[[nodiscard]] std::filesystem::path mission_file_of(const std::string& given);

}  // namespace canopeer::app
