#pragma once

#include <filesystem>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What recorded depth images are in, and what of them is no depth.
struct DepthUnits {
  double per_m = 1000.0;  ///< units of the file in a metre, > 0
  /// Depths from here on are no depth: what some cameras write where nothing came back. 0: no such
  /// limit.
  double max_depth_m = 0.0;
};

/// Reads 16 bit grey as PNG or PGM (binary or text), told apart by content. What a pixel without
/// return holds (0, 65535, and from `max_depth_m` on) becomes 0. The error names the file.
[[nodiscard]] Expected<DepthImage> read_depth_image(const std::filesystem::path& path,
                                                    const DepthUnits& units);

/// The same from the bytes of a file; errors do not name it.
[[nodiscard]] Expected<DepthImage> parse_depth_image(std::string_view bytes,
                                                     const DepthUnits& units);

}  // namespace canopeer
