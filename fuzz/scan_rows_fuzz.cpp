#include <cstddef>
#include <cstdint>
#include <string_view>

#include "canopeer/config/scan_rows_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(canopeer::parse_scan_rows(text, "rows.yaml"));
  return 0;
}
