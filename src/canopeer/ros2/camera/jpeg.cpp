#include "canopeer/ros2/camera/jpeg.h"

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it and does not say so
#include <cstring>
#include <string>

#include "canopeer/ros2/camera/raw_image.h"

namespace canopeer::ros {
namespace {

/// How libjpeg is left when an image cannot be read.
struct JpegExit {
  jpeg_error_mgr manager;
  std::jmp_buf jump;
  char reason[JMSG_LENGTH_MAX];
};

[[noreturn]] void leave_jpeg(j_common_ptr common) {
  auto* const exit = reinterpret_cast<JpegExit*>(common->err);
  exit->manager.format_message(common, exit->reason);
  std::longjmp(exit->jump, 1);
}

/// The library makes grey pixels of what is cut off and only warns of it.
void refuse_cut_off(j_common_ptr common, int level) {
  const int code = common->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) leave_jpeg(common);
}

/// Errors leave by longjmp: all that has a destructor lives in the caller.
bool decode_rows(std::span<const std::uint8_t> bytes, JpegExit* exit, ColorImage* image) {
  jpeg_decompress_struct jpeg;
  std::memset(&jpeg, 0, sizeof jpeg);
  jpeg.err = jpeg_std_error(&exit->manager);
  exit->manager.error_exit = leave_jpeg;
  exit->manager.emit_message = refuse_cut_off;
  if (setjmp(exit->jump) != 0) {
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  if (std::uint64_t{jpeg.image_width} * jpeg.image_height > kMostImagePixels) {
    std::strcpy(exit->reason, "too many pixels");
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
  *image = ColorImage(static_cast<int>(jpeg.output_width), static_cast<int>(jpeg.output_height));
  static_assert(sizeof(Rgb) == 3);
  auto* const pixels = reinterpret_cast<JSAMPLE*>(image->pixels().data());
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = pixels + std::size_t{3} * jpeg.output_width * jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  jpeg_destroy_decompress(&jpeg);
  return true;
}

}  // namespace

Expected<ColorImage> decode_jpeg_image(std::span<const std::uint8_t> bytes) {
  JpegExit exit;
  ColorImage image;
  if (!decode_rows(bytes, &exit, &image)) return fail(std::string("JPEG: ") + exit.reason);
  return image;
}

}  // namespace canopeer::ros
