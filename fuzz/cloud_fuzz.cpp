#include <cstddef>
#include <cstdint>

#include "canopeer/sensing/cloud_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)canopeer::parse_ply(bytes, "fuzz");
  (void)canopeer::parse_pcd(bytes, "fuzz");
  (void)canopeer::parse_csv_cloud(bytes, "fuzz");
  return 0;
}
