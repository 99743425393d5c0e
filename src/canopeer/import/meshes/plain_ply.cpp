#include "canopeer/import/meshes/plain_ply.h"

namespace canopeer {
namespace {

/// An element of one byte that the library knows and makes nothing of.
std::string element_called(std::string_view name) {
  return "element " + std::string(name) + " 1\nproperty uchar red\n";
}

}  // namespace

std::string plain_ply(std::string_view bytes) {
  const std::size_t end = bytes.find("end_header");
  const std::size_t first_element = bytes.find("\nelement ");
  if (!bytes.starts_with("ply") || end == std::string_view::npos || first_element > end) return {};
  if (bytes.substr(0, end).find("format binary") == std::string_view::npos) return {};
  const std::size_t line_end = bytes.find('\n', end);
  if (line_end == std::string_view::npos || line_end + 1 == bytes.size()) return {};
  const char first = bytes[line_end + 1];
  if (first != '\n' && first != '\r') return {};
  const bool has_edges = bytes.substr(0, end).find("\nelement edge ") != std::string_view::npos;
  std::string plain(bytes.substr(0, first_element + 1));
  plain += element_called(has_edges ? "material" : "edge");
  plain += bytes.substr(first_element + 1, line_end - first_element);
  plain += '\x01';  // the element's one byte, which is no end of line
  return plain += bytes.substr(line_end + 1);
}

}  // namespace canopeer
