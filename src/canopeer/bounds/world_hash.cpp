#include "canopeer/bounds/world_hash.h"

#include <bit>
#include <cstdio>

#include "canopeer/scene/scene_hash.h"

namespace canopeer {
namespace {

class ByteHash {
 public:
  void add(std::uint64_t x) {
    for (int i = 0; i < 8; ++i) add_byte(static_cast<unsigned char>(x >> (8 * i)));
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3ULL; }

  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t world_hash(const Scene& scene, std::span<const std::string> robot_files,
                         const CameraIntrinsics& camera) {
  ByteHash hash;
  hash.add(scene_hash(scene));
  for (const std::string& text : robot_files) hash.add(text);
  hash.add(static_cast<std::uint64_t>(camera.width));
  hash.add(static_cast<std::uint64_t>(camera.height));
  for (const double x :
       {camera.fx, camera.fy, camera.cx, camera.cy, camera.min_range_m, camera.max_range_m}) {
    hash.add(x);
  }
  return hash.value();
}

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace canopeer
