#include <cstddef>
#include <cstdint>

#include "canopeer/map/octomap_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)canopeer::parse_octomap(bytes);
  canopeer::VoxelMap map;
  (void)canopeer::parse_octomap_roi(bytes, map);
  return 0;
}
