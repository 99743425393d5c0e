#include "canopeer/sensing/jpeg.h"

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it and does not say so
#include <cstdlib>
#include <cstring>
// After cstdio.
#include <jpeglib.h>
// After jpeglib.h.
#include <jerror.h>

namespace canopeer {
namespace {

static_assert(sizeof(Rgb) == 3);

/// How libjpeg is left where it cannot go on. Everything with a destructor lives in the caller.
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

void keep_quiet(j_common_ptr /*common*/, int /*level*/) {}

jpeg_error_mgr* errors_to(JpegExit* exit, bool whole) {
  jpeg_error_mgr* const manager = jpeg_std_error(&exit->manager);
  manager->error_exit = leave_jpeg;
  manager->emit_message = whole ? refuse_cut_off : keep_quiet;
  return manager;
}

bool decode_jpeg_rows(std::string_view bytes, const JpegLimits& limits, JpegExit* exit,
                      ColorImage* image) {
  jpeg_decompress_struct jpeg;
  std::memset(&jpeg, 0, sizeof jpeg);
  jpeg.err = errors_to(exit, limits.whole);
  if (setjmp(exit->jump) != 0) {
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  if (std::size_t{jpeg.image_width} * jpeg.image_height > limits.most_pixels) {
    std::strcpy(exit->reason, "the picture is too big");
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
  *image = ColorImage(static_cast<int>(jpeg.output_width), static_cast<int>(jpeg.output_height));
  auto* const pixels = reinterpret_cast<JSAMPLE*>(image->pixels().data());
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = pixels + std::size_t{3} * jpeg.output_width * jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  jpeg_destroy_decompress(&jpeg);
  return true;
}

/// It can only run out of memory.
bool encode_jpeg_rows(const ColorImage& image, int quality, JpegExit* exit, unsigned char** bytes,
                      unsigned long* size) {
  jpeg_compress_struct jpeg;
  std::memset(&jpeg, 0, sizeof jpeg);
  jpeg.err = errors_to(exit, true);
  if (setjmp(exit->jump) != 0) {
    jpeg_destroy_compress(&jpeg);
    return false;
  }
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, bytes, size);
  jpeg.image_width = static_cast<JDIMENSION>(image.width());
  jpeg.image_height = static_cast<JDIMENSION>(image.height());
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<JSAMPROW>(
        reinterpret_cast<const JSAMPLE*>(&image.at(0, static_cast<int>(jpeg.next_scanline))));
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  return true;
}

}  // namespace

Expected<ColorImage> parse_jpeg(std::string_view bytes, const JpegLimits& limits) {
  JpegExit exit;
  ColorImage image;
  if (!decode_jpeg_rows(bytes, limits, &exit, &image)) return fail(exit.reason);
  return image;
}

std::string encode_jpeg(const ColorImage& image, int quality) {
  if (image.empty()) return {};
  JpegExit exit;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  std::string jpeg;
  if (encode_jpeg_rows(image, quality, &exit, &bytes, &size)) {
    jpeg.assign(reinterpret_cast<const char*>(bytes), size);
  }
  std::free(bytes);
  return jpeg;
}

}  // namespace canopeer
