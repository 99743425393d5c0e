#include "canopeer/import/meshes/gltf_container.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/percent_encoding.h"
#include "canopeer/import/meshes/gltf_constants.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  if (at > bytes.size() || bytes.size() - at < sizeof word) {
    throw std::runtime_error("binary glTF that is cut off");
  }
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

void add_word(std::uint32_t word, std::string* to) {
  to->append(reinterpret_cast<const char*>(&word), sizeof word);
}

void add_chunk(std::uint32_t kind, std::string data, char filler, std::string* to) {
  data.resize((data.size() + 3) / 4 * 4, filler);
  add_word(static_cast<std::uint32_t>(data.size()), to);
  add_word(kind, to);
  *to += data;
}

/// 0 … 63; −1: no character of base64.
int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) continue;  // padding, ends of lines
    bits = (bits << 6U) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xffU);
  }
  return bytes;
}

}  // namespace

bool is_old_binary_gltf(std::string_view bytes) {
  return bytes.starts_with("glTF") && bytes.size() >= 8 && word_at(bytes, 4) == 1;
}

GltfContainer read_gltf_container(std::string_view bytes) {
  GltfContainer container;
  if (!bytes.starts_with("glTF")) {
    container.json = bytes;
    return container;
  }
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = word_at(bytes, at);
    const std::uint32_t kind = word_at(bytes, at + 4);
    at += 8;
    if (size > bytes.size() - at) throw std::runtime_error("binary glTF that is cut off");
    if (kind == gltf::kJsonChunk && container.json.empty()) container.json = bytes.substr(at, size);
    if (kind == gltf::kBinaryChunk && container.binary.empty()) {
      container.binary = bytes.substr(at, size);
    }
    if (size % 4 != 0) container.aligned = false;
    at += size;
  }
  return container;
}

std::string to_glb(const GltfContainer& container) {
  std::string chunks;
  add_chunk(gltf::kJsonChunk, container.json, ' ', &chunks);
  add_chunk(gltf::kBinaryChunk, container.binary, '\0', &chunks);
  std::string glb;
  add_word(gltf::kMagic, &glb);
  add_word(2, &glb);
  add_word(static_cast<std::uint32_t>(12 + chunks.size()), &glb);
  return glb + chunks;
}

std::string bytes_behind(const std::string& uri, const fs::path& folder) {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) throw std::runtime_error("a data: address without data");
    const std::string_view data = std::string_view(uri).substr(comma + 1);
    const bool base64 = uri.substr(0, comma).ends_with(";base64");
    return base64 ? from_base64(data) : percent_decoded(data);
  }
  std::error_code code;
  for (const std::string& name : {uri, percent_decoded(uri)}) {
    if (!fs::is_regular_file(folder / name, code)) continue;
    auto bytes = read_file(folder / name);
    if (!bytes) throw std::runtime_error(bytes.error().message);
    return std::move(*bytes);
  }
  throw std::runtime_error("its file of numbers is not there: expected " +
                           (folder / percent_decoded(uri)).lexically_normal().string());
}

}  // namespace canopeer
