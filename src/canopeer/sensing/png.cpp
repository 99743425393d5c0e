#include "canopeer/sensing/png.h"

#include <png.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

/// PNG files start with these eight bytes (PNG specification, 5.2).
constexpr unsigned char kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

/// Rows of big-endian samples to a PNG in memory. libpng reports errors by longjmp: everything with
/// a destructor lives in the caller.
bool encode(int width, int height, int bit_depth, int color_type, const std::uint8_t* rows,
            std::size_t row_bytes, std::string* out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(
      png, out,
      [](png_structp p, png_bytep data, png_size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
               bit_depth, color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int v = 0; v < height; ++v) {
    png_write_row(png, rows + static_cast<std::size_t>(v) * row_bytes);
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

Expected<void> write_encoded(const std::filesystem::path& path, int width, int height,
                             int bit_depth, int color_type, const std::vector<std::uint8_t>& rows) {
  if (width <= 0 || height <= 0) return fail("cannot write " + path.string() + ": empty image");
  std::string bytes;
  if (!encode(width, height, bit_depth, color_type, rows.data(),
              rows.size() / static_cast<std::size_t>(height), &bytes)) {
    return fail("cannot write " + path.string() + ": PNG encoder failed");
  }
  return write_file(path, bytes);
}

}  // namespace

Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image) {
  std::vector<std::uint8_t> rows;
  rows.reserve(image.pixels().size() * 3);
  for (const Rgb& c : image.pixels()) rows.insert(rows.end(), {c.r, c.g, c.b});
  return write_encoded(path, image.width(), image.height(), 8, PNG_COLOR_TYPE_RGB, rows);
}

Expected<void> write_depth_png(const std::filesystem::path& path, const DepthImage& depth) {
  std::vector<std::uint8_t> rows;
  rows.reserve(depth.pixels().size() * 2);
  for (const float d : depth.pixels()) {
    // NaN fails the comparison and becomes "no return"; what is beyond 65.5 m saturates.
    const long mm = d > 0.0F ? std::lround(std::fmin(d * 1000.0F, 65535.0F)) : 0;
    rows.push_back(static_cast<std::uint8_t>(mm >> 8));
    rows.push_back(static_cast<std::uint8_t>(mm & 0xff));
  }
  return write_encoded(path, depth.width(), depth.height(), 16, PNG_COLOR_TYPE_GRAY, rows);
}

Expected<ColorImage> read_png(const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->size() < sizeof(kSignature) ||
      std::memcmp(bytes->data(), kSignature, sizeof(kSignature)) != 0) {
    return fail(path.string() + ": not a PNG file");
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes->data(), bytes->size()) == 0) {
    return fail(path.string() + ": " + png.message);
  }
  png.format = PNG_FORMAT_RGB;
  const png_color black{0, 0, 0};
  ColorImage image(static_cast<int>(png.width), static_cast<int>(png.height));
  static_assert(sizeof(Rgb) == 3);
  if (png_image_finish_read(&png, &black, image.pixels().data(), 0, nullptr) == 0) {
    const std::string reason = png.message;
    png_image_free(&png);
    return fail(path.string() + ": " + reason);
  }
  return image;
}

}  // namespace canopeer
