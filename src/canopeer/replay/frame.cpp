#include "canopeer/replay/frame.h"

namespace canopeer {

std::string Frame::bytes() const {
  std::string all = head.substr(0, head.size() - 1);  // up to the closing brace
  all += ",\"bytes\":" + std::to_string(octets.size()) + "}\n";
  return all += octets;
}

/// "type" is the first member of every head that is written here.
std::string_view frame_type(std::string_view bytes) {
  constexpr std::string_view kBegin = "{\"type\":\"";
  if (!bytes.starts_with(kBegin)) return {};
  bytes.remove_prefix(kBegin.size());
  const std::size_t end = bytes.find('"');
  return end == std::string_view::npos ? std::string_view() : bytes.substr(0, end);
}

}  // namespace canopeer
