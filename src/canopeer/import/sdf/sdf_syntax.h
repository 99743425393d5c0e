#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"

namespace canopeer {

/// Whether a file is XML with <sdf> at its root. Error: the file, the line, and what is wrong
/// there, of which libsdformat says no more than that it cannot read the file.
[[nodiscard]] Expected<void> check_sdf_syntax(const std::filesystem::path& path);

}  // namespace canopeer
