#include "canopeer/sensing/depth_file.h"

#include <limits>

#include "canopeer/base/atomic_file.h"
#include "canopeer/sensing/files/pgm.h"
#include "canopeer/sensing/png.h"

namespace canopeer {
namespace {

Expected<DepthImage> parse_depth_pgm(std::string_view bytes, double units_per_m) {
  const auto samples = parse_pgm16(bytes);
  if (!samples) return tl::unexpected(samples.error());
  DepthImage depth(samples->width(), samples->height());
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    depth.pixels()[i] = depth_of_units(samples->pixels()[i], units_per_m);
  }
  return depth;
}

std::string_view other_picture(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xD8\xFF")) return "JPEG";
  if (bytes.starts_with("II*") || bytes.starts_with("MM")) return "TIFF";
  if (bytes.starts_with("v/1\x01")) return "OpenEXR";
  if (bytes.starts_with("\x93NUMPY")) return "NumPy";
  if (bytes.starts_with("version https://git-lfs")) return "a Git LFS pointer (`git lfs pull`)";
  return {};
}

}  // namespace

Expected<DepthImage> parse_depth_image(std::string_view bytes, const DepthUnits& units) {
  if (const auto other = other_picture(bytes); !other.empty()) {
    return fail("not a depth image: expected 16 bit grey PNG or PGM, got " + std::string(other));
  }
  auto depth =
      is_pgm(bytes) ? parse_depth_pgm(bytes, units.per_m) : parse_depth_png(bytes, units.per_m);
  if (depth && units.max_depth_m > 0.0) {
    for (float& d : depth->pixels()) {
      if (d >= static_cast<float>(units.max_depth_m)) d = 0.0F;
    }
  }
  return depth;
}

Expected<DepthImage> read_depth_image(const std::filesystem::path& path, const DepthUnits& units) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto depth = parse_depth_image(*bytes, units);
  if (!depth) return fail_in(path.string(), depth.error());
  return depth;
}

}  // namespace canopeer
