#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer::ros {

/// The URDF that a robot.yaml names, for /robot_description: relative names of meshes are
/// `file://` and whole, others stay as they are.
[[nodiscard]] Expected<std::string> robot_description_text(const std::filesystem::path& robot_file);

/// The same of the text of a URDF that lies in `folder`.
[[nodiscard]] std::string with_whole_file_names(std::string_view urdf,
                                                const std::filesystem::path& folder);

}  // namespace canopeer::ros
