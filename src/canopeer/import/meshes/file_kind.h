#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace canopeer {

/// How many of a file's first bytes file kinds are told by.
inline constexpr std::size_t kFileHeadBytes = 4096;

/// For a file that is none of those read here, whatever its name says: what it is and what to do,
/// to follow the file's name ("is FBX; export …"). `head`: its first kFileHeadBytes, or all of it.
/// Nothing: it may be one that is read.
[[nodiscard]] std::optional<std::string> foreign_file(std::string_view head);

/// The mesh format that the first bytes leave no doubt about, as an ending: ".glb", ".ply", ".dae".
/// OBJ, STL and glTF as text begin with nothing of their own. Empty: none of those.
[[nodiscard]] std::string_view mesh_ending_by_content(std::string_view head);

}  // namespace canopeer
