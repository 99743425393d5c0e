#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer {

/// Writes bytes compressed, behind a line that says what they are, with their size and checksum.
[[nodiscard]] Expected<void> write_packed(const std::filesystem::path& path, std::string_view what,
                                          std::string_view bytes);
/// Reads them; the error names the file and says what is wrong.
[[nodiscard]] Expected<std::string> read_packed(const std::filesystem::path& path,
                                                std::string_view what);

}  // namespace canopeer
