#include <zstd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "canopeer/base/byte_order.h"
#include "canopeer/map/cmap_file.h"
#include "canopeer/map/files/cmap_format.h"

namespace {

using canopeer::append_number;
using canopeer::load_number;
using namespace canopeer::cmap_format;

void put_checksum(std::string& bytes, std::size_t from, std::size_t at) {
  std::string sum;
  append_number(sum, checksum(std::string_view(bytes).substr(from, at - from)));
  std::copy(sum.begin(), sum.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

// Right checksums, so that what they protect is read too.
std::string repaired(std::string bytes) {
  if (bytes.size() < kHeaderBytes) return bytes;
  put_checksum(bytes, 0, kHeaderBytes - 4);
  for (std::size_t at = kHeaderBytes; bytes.size() - at >= kGroupFrameBytes;) {
    const std::uint64_t blocks = load_number<std::uint32_t>(&bytes[at]);
    const std::uint64_t end = at + 8 + blocks * 8 + load_number<std::uint32_t>(&bytes[at + 4]);
    if (end + 4 > bytes.size()) break;
    put_checksum(bytes, at, end);
    at = end + 4;
  }
  return bytes;
}

// A file whose only group has this content, with as many blocks as its first byte says.
std::string file_around(std::string_view content) {
  const std::string whole = canopeer::cmap_bytes(canopeer::VoxelMap());
  std::string packed(ZSTD_compressBound(content.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), 1));
  const std::uint32_t blocks = content.empty() ? 1 : static_cast<unsigned char>(content[0]);
  std::string bytes = whole;
  append_number(bytes, blocks);
  append_number(bytes, static_cast<std::uint32_t>(packed.size()));
  for (std::uint64_t i = 0; i < blocks; ++i) append_number(bytes, i);
  bytes += packed;
  append_number(bytes, std::uint32_t{0});
  return repaired(bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)canopeer::parse_cmap(bytes);
  (void)canopeer::parse_cmap(repaired(std::string(bytes)));
  (void)canopeer::parse_cmap(file_around(bytes));
  return 0;
}
