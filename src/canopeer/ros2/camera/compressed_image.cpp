#include "canopeer/ros2/camera/compressed_image.h"

#include <cmath>
#include <string>
#include <string_view>

#include "canopeer/base/byte_order.h"
#include "canopeer/ros2/camera/raw_image.h"
#include "canopeer/sensing/jpeg.h"
#include "canopeer/sensing/png.h"

namespace canopeer::ros {
namespace {

std::string_view text_of(const std::vector<std::uint8_t>& data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

bool is_png(std::string_view bytes) { return bytes.substr(0, 4) == "\x89PNG"; }

bool has(const std::string& format, const char* word) {
  return format.find(word) != std::string::npos;
}

/// What the header chunk says (PNG specification, 11.2.2), before anything is allocated.
Expected<void> check_png_size(std::string_view bytes) {
  if (!is_png(bytes) || bytes.size() < 24) return fail("not a PNG image");
  return check_image_size(load_number<std::uint32_t>(bytes.data() + 16, ByteOrder::big),
                          load_number<std::uint32_t>(bytes.data() + 20, ByteOrder::big));
}

Expected<ColorImage> color_from_png(std::string_view bytes) {
  if (auto size = check_png_size(bytes); !size) return tl::unexpected(size.error());
  return parse_png(bytes);
}

Expected<ColorImage> color_from_jpeg(std::string_view bytes) {
  auto image = parse_jpeg(bytes, {kMostImagePixels});
  if (!image) return fail_in("JPEG", image.error());
  return image;
}

/// `units_per_m` of the samples; 1: the samples themselves.
Expected<DepthImage> depth_from_png(std::string_view bytes, double units_per_m) {
  if (auto size = check_png_size(bytes); !size) return tl::unexpected(size.error());
  return parse_depth_png(bytes, units_per_m);
}

/// What precedes the PNG: which quantisation (0: inverse depth), and its two parameters. Packed as
/// a C struct of an int and two floats.
constexpr std::size_t kDepthHead = 12;

/// sample = a / depth + b; 0: no return.
Expected<DepthImage> inverse_depth(std::string_view data) {
  const auto a = load_number<float>(data.data() + 4);
  const auto b = load_number<float>(data.data() + 8);
  if (!(std::isfinite(a) && std::isfinite(b) && a > 0.0F)) {
    return fail("compressedDepth: its quantisation makes no sense");
  }
  auto depth = depth_from_png(data.substr(kDepthHead), 1.0);
  if (!depth) return depth;
  for (float& d : depth->pixels()) {
    const float metres = d > 0.0F ? a / (d - b) : 0.0F;
    d = metres > 0.0F && std::isfinite(metres) ? metres : 0.0F;
  }
  return depth;
}

}  // namespace

Expected<ColorImage> color_of(const sensor_msgs::CompressedImage& message) {
  const std::string_view bytes = text_of(message.data);
  if (is_png(bytes)) return color_from_png(bytes);
  if (bytes.substr(0, 2) == "\xff\xd8") return color_from_jpeg(bytes);
  return fail("compressed images are '" + message.format + "'; JPEG and PNG are read");
}

Expected<DepthImage> depth_of(const sensor_msgs::CompressedImage& message) {
  const std::string_view bytes = text_of(message.data);
  if (is_png(bytes)) return depth_from_png(bytes, 1000.0);
  if (!has(message.format, "compressedDepth")) {
    return fail("compressed depth images are '" + message.format +
                "'; use the topic that ends with /compressedDepth");
  }
  if (has(message.format, "rvl")) {
    return fail(
        "depth images are compressed by RVL; set the driver's parameter ...compressedDepth"
        ".format to png");
  }
  if (bytes.size() <= kDepthHead) return fail("compressedDepth: cut off");
  if (message.format.rfind("32FC1", 0) == 0) return inverse_depth(bytes);
  return depth_from_png(bytes.substr(kDepthHead), 1000.0);
}

Expected<Image<PixelLabel>> labels_of(const sensor_msgs::CompressedImage& message) {
  if (!is_png(text_of(message.data))) return fail("labels can be compressed as PNG only");
  const auto grey = color_from_png(text_of(message.data));
  if (!grey) return tl::unexpected(grey.error());
  std::vector<std::uint8_t> values;
  values.reserve(grey->pixels().size());
  for (const Rgb& pixel : grey->pixels()) values.push_back(pixel.r);
  return labels_from(grey->width(), grey->height(), values.data(),
                     static_cast<std::size_t>(grey->width()));
}

}  // namespace canopeer::ros
