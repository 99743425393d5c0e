#include "canopeer/geometry/packed_file.h"

#include <zlib.h>
#include <zstd.h>

#include <cstdint>

#include "canopeer/base/atomic_file.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 33;  // 8 GiB: more is damage
constexpr int kLevel = 1;  // such files are written often and read seldom

std::uint64_t checksum(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

std::string wrong_line(std::string_view file, const PackedKind& kind) {
  const std::string name(kind.name);
  const std::string_view word = kind.line.substr(0, kind.line.find(' ') + 1);
  return file.starts_with(word) ? "a " + name + " of another version of canopeer"
                                : "this is no " + name;
}

Expected<std::string> unpacked(std::string_view file, const PackedKind& kind) {
  if (!file.starts_with(kind.line)) return fail(wrong_line(file, kind));
  file.remove_prefix(kind.line.size());
  std::uint64_t size = 0;
  std::uint64_t sum = 0;
  std::string packed;
  if (auto ok = read_state_bytes(file, size, sum, packed); !ok) return tl::unexpected(ok.error());
  if (checksum(packed) != sum || size > kMostBytes ||
      ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) {
    return fail("damaged");
  }
  std::string bytes(size, '\0');
  const std::size_t got = ZSTD_decompress(bytes.data(), size, packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) return fail("damaged");
  return bytes;
}

}  // namespace

Expected<void> write_packed(const std::filesystem::path& path, const PackedKind& kind,
                            std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) {
    return fail(path.string() + ": cannot be compressed: " + ZSTD_getErrorName(size));
  }
  packed.resize(size);
  const auto raw_size = static_cast<std::uint64_t>(bytes.size());
  return write_file(path, std::string(kind.line) + state_bytes(raw_size, checksum(packed), packed));
}

Expected<std::string> read_packed(const std::filesystem::path& path, const PackedKind& kind) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected(file.error());
  auto bytes = unpacked(*file, kind);
  if (!bytes) return fail_in(path.string(), bytes.error());
  return bytes;
}

}  // namespace canopeer
