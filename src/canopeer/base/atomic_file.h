#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer {

/// Writes `content` under a temporary name beside `path`, then renames: a reader sees the old file
/// or the whole new one.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path,
                                        std::string_view content);
/// The same for content in pieces, one after the other.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path,
                                        std::span<const std::string_view> pieces);

/// The whole file as bytes; the error names the file and the reason.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path);

}  // namespace canopeer
