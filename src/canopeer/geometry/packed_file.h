#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer {

/// What a packed file is.
struct PackedKind {
  std::string_view line;  ///< its first: a word and a version, e.g. "CANOPEER-STATE 1\n"
  std::string_view name;  ///< in messages, e.g. "run state"
};

/// Writes bytes compressed, behind the kind's line, with their size and checksum; the whole file or
/// none. The same bytes give the same file.
[[nodiscard]] Expected<void> write_packed(const std::filesystem::path& path, const PackedKind& kind,
                                          std::string_view bytes);
/// Reads them; the error names the file and says what is wrong: another kind, another version,
/// damaged.
[[nodiscard]] Expected<std::string> read_packed(const std::filesystem::path& path,
                                                const PackedKind& kind);

}  // namespace canopeer
