#include "canopeer/import/meshes/picture_kind.h"

#include <algorithm>
#include <array>

#include "canopeer/import/meshes/file_kind.h"

namespace canopeer {
namespace {

using namespace std::string_view_literals;

struct Format {
  std::size_t at;
  std::string_view bytes;
  std::string_view what;
};

/// Pictures there is no library for in both Debian releases, or that no plant wears.
constexpr std::array kOthers = {
    Format{0, "DDS "sv, "a DDS texture"},
    Format{0, "\xabKTX 20\xbb"sv, "a KTX2 texture"},
    Format{0, "\xabKTX 11\xbb"sv, "a KTX texture"},
    Format{0, "PVR\x03"sv, "a PVR texture"},
    Format{0, "sB"sv, "a Basis texture"},
    Format{0, "II*\0"sv, "TIFF"},
    Format{0, "MM\0*"sv, "TIFF"},
    Format{0, "v/1\x01"sv, "OpenEXR"},
    Format{0, "#?RADIANCE"sv, "Radiance HDR"},
    Format{4, "ftypavif"sv, "AVIF"},
    Format{4, "ftyphei"sv, "HEIC"},
    Format{4, "jP  \r\n"sv, "JPEG 2000"},
    Format{0, "\xff\x0a"sv, "JPEG XL"},
    Format{0, "gimp xcf"sv, "a GIMP picture"},
    Format{0, "<svg"sv, "SVG"},
    Format{0, "qoif"sv, "QOI"},
    Format{0, "\x0a\x05\x01"sv, "PCX"},
    Format{0, "P6"sv, "a PPM picture"},
    Format{0, "P5"sv, "a PGM picture"},
};

int byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

int two_bytes_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) + 256 * byte_at(bytes, at + 1);
}

bool one_of(int value, std::initializer_list<int> values) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// A header of TGA whose fields go together.
bool is_tga(std::string_view bytes) {
  if (bytes.size() < 18) return false;
  const int palette = byte_at(bytes, 1);
  const int kind = byte_at(bytes, 2) & ~8;  // 8: runs of pixels
  if (!one_of(kind, {1, 2, 3}) || palette > 1 || byte_at(bytes, 2) > 11) return false;
  if (kind == 1 && (palette != 1 || !one_of(byte_at(bytes, 7), {15, 16, 24, 32}))) return false;
  if (two_bytes_at(bytes, 12) == 0 || two_bytes_at(bytes, 14) == 0) return false;
  const int bits = byte_at(bytes, 16);
  return kind == 2 ? one_of(bits, {15, 16, 24, 32}) : one_of(bits, {8, 16});
}

}  // namespace

PictureKind picture_kind(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return PictureKind::png;
  if (bytes.starts_with("\xff\xd8\xff")) return PictureKind::jpeg;
  if (bytes.starts_with("BM")) return PictureKind::bmp;
  if (bytes.starts_with("GIF8")) return PictureKind::gif;
  if (bytes.starts_with("8BPS")) return PictureKind::psd;
  if (bytes.starts_with("RIFF") && bytes.size() > 12 && bytes.substr(8).starts_with("WEBP")) {
    return PictureKind::webp;
  }
  return is_tga(bytes) ? PictureKind::tga : PictureKind::unknown;
}

std::string picture_refusal(std::string_view bytes) {
  for (const Format& other : kOthers) {
    if (bytes.size() <= other.at || !bytes.substr(other.at).starts_with(other.bytes)) continue;
    return "is " + std::string(other.what) +
           ", which is not read; convert it to PNG (the new file may keep the old name: what is in "
           "it counts)";
  }
  if (const auto foreign = foreign_file(bytes)) return *foreign;
  return "expected a picture: PNG, JPEG, TGA, BMP, GIF, PSD or WebP";
}

}  // namespace canopeer
