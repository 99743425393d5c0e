#include <cstddef>
#include <cstdint>
#include <string_view>

#include "canopeer/scene/files/scene_format.h"
#include "canopeer/scene/scene_file.h"

/// The bytes as a file, and as what lies packed in a file whose checksum is right.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)canopeer::parse_scene(bytes);
  (void)canopeer::parse_scene(canopeer::scene_format::around(bytes));
  return 0;
}
