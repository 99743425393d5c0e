#include <cstddef>
#include <cstdint>
#include <string_view>

#include "canopeer/import/meshes/collada_asset.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(canopeer::parse_collada_asset(text, "a.dae"));
  return 0;
}
