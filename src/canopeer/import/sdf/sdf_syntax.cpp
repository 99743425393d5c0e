#include "canopeer/import/sdf/sdf_syntax.h"

#include <tinyxml2.h>

#include <algorithm>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

/// "Error=XML_ERROR_MISMATCHED_ELEMENT ErrorID=14 (0xe) Line number=9: …" without its own names.
std::string reason(const tinyxml2::XMLDocument& document) {
  std::string name = document.ErrorName();
  if (name.starts_with("XML_ERROR_")) name.erase(0, 10);
  if (name.starts_with("XML_")) name.erase(0, 4);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
    return c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  });
  return name;
}

}  // namespace

Expected<void> check_sdf_syntax(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  tinyxml2::XMLDocument document;
  if (document.Parse(text->data(), text->size()) != tinyxml2::XML_SUCCESS) {
    return fail(path.string() + ":" + std::to_string(std::max(document.ErrorLineNum(), 1)) +
                ": is no sound XML: " + reason(document));
  }
  const tinyxml2::XMLElement* const root = document.RootElement();
  if (root == nullptr || std::string(root->Name()) != "sdf") {
    return fail(path.string() + ":" + std::to_string(root == nullptr ? 1 : root->GetLineNum()) +
                ": expected <sdf version=…> at the root" +
                (root == nullptr ? "" : ", found <" + std::string(root->Name()) + ">"));
  }
  return {};
}

}  // namespace canopeer
