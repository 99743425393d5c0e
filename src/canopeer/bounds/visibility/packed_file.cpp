#include "canopeer/bounds/visibility/packed_file.h"

#include <zlib.h>
#include <zstd.h>

#include <cstdint>

#include "canopeer/base/atomic_file.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

constexpr std::uint64_t kMostPoolBytes = std::uint64_t{1} << 33;  // 8 GiB: more is damage
constexpr int kPoolLevel = 1;                                     // written often while it is made

std::uint64_t pool_checksum(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

Expected<std::string> unpack(std::string_view file, std::string_view what) {
  if (!file.starts_with(what)) return fail("this is not what was expected, or of another version");
  file.remove_prefix(what.size());
  std::uint64_t size = 0;
  std::uint64_t sum = 0;
  std::string packed;
  if (auto ok = read_state_bytes(file, size, sum, packed); !ok) return tl::unexpected(ok.error());
  if (pool_checksum(packed) != sum || size > kMostPoolBytes ||
      ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) {
    return fail("damaged");
  }
  std::string bytes(size, '\0');
  const std::size_t got = ZSTD_decompress(bytes.data(), size, packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) return fail("damaged");
  return bytes;
}

}  // namespace

Expected<void> write_packed(const std::filesystem::path& path, std::string_view what,
                            std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kPoolLevel);
  if (ZSTD_isError(size) != 0) {
    return fail(path.string() + ": cannot be compressed: " + ZSTD_getErrorName(size));
  }
  packed.resize(size);
  const auto raw_size = static_cast<std::uint64_t>(bytes.size());
  return write_file(path, std::string(what) + state_bytes(raw_size, pool_checksum(packed), packed));
}

Expected<std::string> read_packed(const std::filesystem::path& path, std::string_view what) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected(file.error());
  auto bytes = unpack(*file, what);
  if (!bytes) return fail_in(path.string(), bytes.error());
  return bytes;
}

}  // namespace canopeer
