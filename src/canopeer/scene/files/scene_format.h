#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

// The layout of scene files, see docs/formats.md.
namespace canopeer::scene_format {

/// As in PNG, the first bytes show when a file went through a transfer that changed its line ends
/// or its eighth bits.
inline constexpr std::string_view kMagic(
    "\x89"
    "CSCENE\r\n\x1a",
    10);
inline constexpr std::uint32_t kVersion = 1;

/// Magic, version, size of what is packed, checksum of all that follows the magic but itself.
inline constexpr std::size_t kHeaderBytes = kMagic.size() + 4 + 4 + 4;
inline constexpr std::uint32_t kMostUnpacked = 1U << 28U;
/// Of all parts together, copies of models counted once.
inline constexpr std::uint64_t kMostTriangles = 20'000'000;
/// A coordinate in grid steps: what a float holds exactly.
inline constexpr std::int64_t kMostSteps = std::int64_t{1} << 22;

/// What a part has beside its mesh.
inline constexpr std::uint8_t kSeeThrough = 1;
inline constexpr std::uint8_t kVertexColors = 2;
inline constexpr std::uint8_t kTextured = 4;
inline constexpr std::uint8_t kOwnNormals = 8;
inline constexpr std::uint8_t kNoNormals = 16;
inline constexpr std::uint8_t kAllFlags = 31;

/// The file around its content, which is packed here.
[[nodiscard]] std::string around(std::string_view content);

[[nodiscard]] std::uint32_t checksum(std::string_view version_and_size, std::string_view packed);

}  // namespace canopeer::scene_format
