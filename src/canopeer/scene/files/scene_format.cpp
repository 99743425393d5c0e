#include "canopeer/scene/files/scene_format.h"

#include <zlib.h>
#include <zstd.h>

#include "canopeer/base/byte_order.h"
#include "canopeer/base/check.h"

namespace canopeer::scene_format {
namespace {

constexpr int kLevel = 19;  // written once, read often

const Bytef* octets(std::string_view bytes) { return reinterpret_cast<const Bytef*>(bytes.data()); }

}  // namespace

std::uint32_t checksum(std::string_view version_and_size, std::string_view packed) {
  const uLong head = crc32_z(0, octets(version_and_size), version_and_size.size());
  return static_cast<std::uint32_t>(crc32_z(head, octets(packed), packed.size()));
}

std::string around(std::string_view content) {
  CANOPEER_CHECK(content.size() <= kMostUnpacked, "the content of a scene file is bounded");
  std::string packed(ZSTD_compressBound(content.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), kLevel);
  CANOPEER_CHECK(ZSTD_isError(size) == 0, "zstd compresses what fits");
  packed.resize(size);
  std::string file;
  append_number(file, kVersion);
  append_number(file, static_cast<std::uint32_t>(content.size()));
  append_number(file, checksum(file, packed));
  return std::string(kMagic) + file + packed;
}

}  // namespace canopeer::scene_format
