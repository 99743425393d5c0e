#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Writes 8 bit RGB. The error names the file.
[[nodiscard]] Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image);

/// Writes 16 bit grey (0: no return; what is beyond 16 bits becomes 65535), the usual exchange
/// format of depth images; in millimetres unless `units_per_m` says otherwise.
[[nodiscard]] Expected<void> write_depth_png(const std::filesystem::path& path,
                                             const DepthImage& depth, double units_per_m = 1000.0);

/// 8 bit grey as the bytes of a file; empty for an image without pixels.
[[nodiscard]] std::string encode_png(const Mask& image);

/// Reads 8 bit RGB (grey, palette and alpha are converted). As the other readers it refuses an
/// image larger than the file can hold, before it takes the memory.
[[nodiscard]] Expected<ColorImage> read_png(const std::filesystem::path& path);

/// The depth that a sample of 16 bits stands for. 0 and 65535 say that there is none: cameras and
/// drivers write either, and no measurement reaches the end of the range. Both give 0.
[[nodiscard]] constexpr float depth_of_units(int units, double units_per_m) {
  return units == 65535 ? 0.0F : static_cast<float>(units / units_per_m);
}

/// Reads 16 bit grey, `units_per_m` of which are a metre (> 0; 1000 for what write_depth_png
/// writes, 5000 in the TUM RGB-D data sets), by depth_of_units().
[[nodiscard]] Expected<DepthImage> read_depth_png(const std::filesystem::path& path,
                                                  double units_per_m);

/// The same from the bytes of a file; errors do not name it.
[[nodiscard]] Expected<ColorImage> parse_png(std::string_view bytes);
[[nodiscard]] Expected<DepthImage> parse_depth_png(std::string_view bytes, double units_per_m);

}  // namespace canopeer
