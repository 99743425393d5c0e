#include <cstddef>
#include <cstdint>
#include <string_view>

#include "canopeer/import/sdf/sdf_world.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(canopeer::parse_sdf_world(text, "/nowhere/w.world", canopeer::ModelPaths({})));
  return 0;
}
