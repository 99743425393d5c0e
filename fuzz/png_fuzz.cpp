#include <cstddef>
#include <cstdint>

#include "canopeer/sensing/depth_file.h"
#include "canopeer/sensing/png.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)canopeer::parse_png(bytes);
  (void)canopeer::parse_depth_image(bytes, {5000.0, 10.0});
  return 0;
}
