#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer {

/// Writes `content` under a temporary name beside `path`, then renames: a reader sees the old file
/// or the whole new one.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path,
                                        std::string_view content);

/// The whole file as bytes; the error names the file and the reason.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path);

}  // namespace canopeer
