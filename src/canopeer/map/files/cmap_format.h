#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "canopeer/map/storage/block.h"

namespace canopeer::cmap_format {

// The layout is in docs/formats.md. As in PNG, the first bytes show when a file went through a
// transfer that changed its line ends or its eighth bits.
inline constexpr std::string_view kMagic(
    "\x89"
    "CMAP\r\n\x1a",
    8);
inline constexpr std::uint32_t kVersion = 1;

/// Log-odds are whole multiples of this.
inline constexpr double kLogOddsUnit = 1.0 / 2048.0;

/// Magic, version, 7 options, 4 counts, checksum.
inline constexpr std::size_t kHeaderBytes = kMagic.size() + 4 + 7 * 8 + 4 * 8 + 4;
/// A group of blocks: their number, compressed size, …, checksum.
inline constexpr std::size_t kGroupFrameBytes = 4 + 4 + 4;
inline constexpr std::size_t kGroupBlocks = 1024;  // more fit in no group
inline constexpr std::size_t kMaskBytes = kBlockVoxels / 8;
inline constexpr std::size_t kMaxBlockBytes =
    2 * (kMaskBytes + kBlockVoxels * sizeof(std::int16_t));

std::uint32_t checksum(std::string_view bytes);

}  // namespace canopeer::cmap_format
