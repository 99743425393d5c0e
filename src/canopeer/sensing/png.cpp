#include "canopeer/sensing/png.h"

#include <png.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"

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

struct PngHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bit_depth = 0;
  int color_type = 0;
};

/// What the header chunk says (PNG specification, 11.2.2), if the file is long enough to hold such
/// an image.
Expected<PngHeader> check_header(std::string_view bytes) {
  constexpr std::size_t kHeaderChunkEnd = 33;
  if (bytes.size() < sizeof(kSignature) ||
      std::memcmp(bytes.data(), kSignature, sizeof(kSignature)) != 0) {
    return fail("not a PNG file");
  }
  if (bytes.size() < kHeaderChunkEnd) return fail("the PNG file was cut off");
  PngHeader header;
  header.width = load_number<std::uint32_t>(bytes.data() + 16, ByteOrder::big);
  header.height = load_number<std::uint32_t>(bytes.data() + 20, ByteOrder::big);
  header.bit_depth = static_cast<unsigned char>(bytes[24]);
  header.color_type = static_cast<unsigned char>(bytes[25]);
  // Deflate makes at most 1032 bytes of one; a pixel has a bit at least.
  constexpr std::uint64_t kMaxPixelsPerByte = 1032 * 8;
  if (std::uint64_t{header.width} * header.height > kMaxPixelsPerByte * bytes.size()) {
    return fail("states " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                " pixels, more than a file of " + std::to_string(bytes.size()) +
                " bytes can hold: damaged");
  }
  return header;
}

struct PngSource {
  const char* next;
  std::size_t left;
  std::string* error;
};

/// The samples of a 16 bit grey PNG, most significant bytes first, into `samples`. As encode():
/// nothing with a destructor lives here.
bool decode_gray16(std::string_view bytes, const PngHeader& header, std::uint8_t* samples,
                   std::string* error) {
  PngSource source{bytes.data(), bytes.size(), error};
  png_structp png = png_create_read_struct(
      PNG_LIBPNG_VER_STRING, &source,
      [](png_structp p, png_const_charp message) {
        *static_cast<PngSource*>(png_get_error_ptr(p))->error = message;
        png_longjmp(p, 1);
      },
      [](png_structp, png_const_charp) {});
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &source, [](png_structp p, png_bytep out, png_size_t size) {
    auto* from = static_cast<PngSource*>(png_get_io_ptr(p));
    if (size > from->left) png_error(p, "the PNG file was cut off");
    std::memcpy(out, from->next, size);
    from->next += size;
    from->left -= size;
  });
  png_read_info(png, info);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const std::size_t row_bytes = std::size_t{2} * header.width;
  if (png_get_rowbytes(png, info) != row_bytes) png_error(png, "the header is damaged");
  for (int pass = 0; pass < passes; ++pass) {
    for (std::uint32_t v = 0; v < header.height; ++v) {
      png_read_row(png, samples + v * row_bytes, nullptr);
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image) {
  std::vector<std::uint8_t> rows;
  rows.reserve(image.pixels().size() * 3);
  for (const Rgb& c : image.pixels()) rows.insert(rows.end(), {c.r, c.g, c.b});
  return write_encoded(path, image.width(), image.height(), 8, PNG_COLOR_TYPE_RGB, rows);
}

std::string encode_png(const Mask& image) {
  std::string bytes;
  if (image.empty()) return bytes;
  encode(image.width(), image.height(), 8, PNG_COLOR_TYPE_GRAY, image.pixels().data(),
         static_cast<std::size_t>(image.width()), &bytes);
  return bytes;
}

Expected<void> write_depth_png(const std::filesystem::path& path, const DepthImage& depth,
                               double units_per_m) {
  const auto scale = static_cast<float>(units_per_m);
  std::vector<std::uint8_t> rows;
  rows.reserve(depth.pixels().size() * 2);
  for (const float d : depth.pixels()) {
    // NaN fails the comparison and becomes "no return"; what is beyond 16 bits saturates.
    const long units = d > 0.0F ? std::lround(std::fmin(d * scale, 65535.0F)) : 0;
    rows.push_back(static_cast<std::uint8_t>(units >> 8));
    rows.push_back(static_cast<std::uint8_t>(units & 0xff));
  }
  return write_encoded(path, depth.width(), depth.height(), 16, PNG_COLOR_TYPE_GRAY, rows);
}

Expected<ColorImage> parse_png(std::string_view bytes) {
  if (auto plausible = check_header(bytes); !plausible) return tl::unexpected(plausible.error());
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return fail(png.message);
  }
  png.format = PNG_FORMAT_RGB;
  const png_color black{0, 0, 0};
  ColorImage image(static_cast<int>(png.width), static_cast<int>(png.height));
  static_assert(sizeof(Rgb) == 3);
  if (png_image_finish_read(&png, &black, image.pixels().data(), 0, nullptr) == 0) {
    const std::string reason = png.message;
    png_image_free(&png);
    return fail(reason);
  }
  return image;
}

Expected<DepthImage> parse_depth_png(std::string_view bytes, double units_per_m) {
  const auto header = check_header(bytes);
  if (!header) return tl::unexpected(header.error());
  if (header->bit_depth != 16 || header->color_type != PNG_COLOR_TYPE_GRAY) {
    return fail("not a depth image: expected 16 bit grey, got " +
                std::to_string(header->bit_depth) + " bit" +
                (header->color_type == PNG_COLOR_TYPE_GRAY ? " grey" : " colour"));
  }
  std::vector<std::uint8_t> samples(std::size_t{2} * header->width * header->height);
  std::string reason;
  if (!decode_gray16(bytes, *header, samples.data(), &reason)) return fail(reason);
  DepthImage depth(static_cast<int>(header->width), static_cast<int>(header->height));
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    const int units = samples[2 * i] << 8 | samples[2 * i + 1];
    depth.pixels()[i] = depth_of_units(units, units_per_m);
  }
  return depth;
}

Expected<ColorImage> read_png(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto image = parse_png(*bytes);
  if (!image) return fail_in(path.string(), image.error());
  return image;
}

Expected<DepthImage> read_depth_png(const std::filesystem::path& path, double units_per_m) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto depth = parse_depth_png(*bytes, units_per_m);
  if (!depth) return fail_in(path.string(), depth.error());
  return depth;
}

}  // namespace canopeer
