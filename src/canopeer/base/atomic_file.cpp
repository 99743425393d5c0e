#include "canopeer/base/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <system_error>

namespace canopeer {
namespace {

/// Of a temporary name. Two processes, on two machines with a shared folder perhaps, may write the
/// same file at the same time: each whole, the later one stays.
std::string own_ending() {
  char text[16];
  std::snprintf(text, sizeof text, ".%08x.part", std::random_device()());
  return text;
}

}  // namespace

Expected<void> write_file(const std::filesystem::path& path, std::string_view content) {
  return write_file(path, std::span<const std::string_view>(&content, 1));
}

Expected<void> write_file(const std::filesystem::path& path,
                          std::span<const std::string_view> pieces) {
  const std::filesystem::path temporary = path.string() + own_ending();
  std::error_code code;
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    for (const std::string_view piece : pieces) {
      out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
    }
    out.flush();
    if (!out) {
      const std::string reason = std::strerror(errno);
      out.close();
      std::filesystem::remove(temporary, code);
      return fail(path.string() + ": cannot write: " + reason);
    }
  }
  std::filesystem::rename(temporary, path, code);
  if (code) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return fail(path.string() + ": cannot write: " + code.message());
  }
  return {};
}

Expected<std::string> read_file(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return fail(path.string() + ": is a directory, expected a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) return fail(path.string() + ": cannot read: " + std::strerror(errno));
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::string content;
  while (in) {
    const std::size_t before = content.size();
    content.resize(before + kChunk);
    in.read(&content[before], static_cast<std::streamsize>(kChunk));
    content.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) return fail(path.string() + ": cannot read: " + std::strerror(errno));
  return content;
}

}  // namespace canopeer
