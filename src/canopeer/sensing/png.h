#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Writes 8 bit RGB. The error names the file.
[[nodiscard]] Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image);

/// Writes 16 bit grey in millimetres (0: no return), the usual exchange format of depth images.
[[nodiscard]] Expected<void> write_depth_png(const std::filesystem::path& path,
                                             const DepthImage& depth);

/// Reads 8 bit RGB (grey, palette and alpha are converted).
[[nodiscard]] Expected<ColorImage> read_png(const std::filesystem::path& path);

}  // namespace canopeer
