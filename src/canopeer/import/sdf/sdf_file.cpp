#include "canopeer/import/sdf/sdf_file.h"

#include <tinyxml2.h>

#include <algorithm>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/text_lines.h"
#include "canopeer/import/meshes/file_kind.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

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

struct SdfFile::Document {
  tinyxml2::XMLDocument xml;
};

std::optional<SdfVersion> to_sdf_version(std::string_view text) {
  const auto numbers = words_of(text, ".");
  if (numbers.size() != 2) return std::nullopt;
  const auto major = to_integer(numbers[0]);
  const auto minor = to_integer(numbers[1]);
  if (!major || !minor || *major < 0 || *minor < 0 || *major > 99 || *minor > 99) {
    return std::nullopt;
  }
  return SdfVersion{static_cast<int>(*major), static_cast<int>(*minor)};
}

SdfFile::SdfFile(fs::path path, std::unique_ptr<const Document> document)
    : path_(std::move(path)), document_(std::move(document)) {
  version_ = to_sdf_version(root().attribute("version").value_or("")).value_or(kNewestSdf);
}

SdfFile::~SdfFile() = default;

SdfElement SdfFile::root() const { return {document_->xml.RootElement(), this}; }

Expected<std::unique_ptr<const SdfFile>> SdfFile::parse(std::string_view text, fs::path path) {
  auto document = std::make_unique<Document>();
  tinyxml2::XMLDocument& xml = document->xml;
  if (xml.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return fail(path.string() + ":" + std::to_string(std::max(xml.ErrorLineNum(), 1)) +
                ": is no sound XML: " + reason(xml));
  }
  const tinyxml2::XMLElement* const root = xml.RootElement();
  const std::string_view tag = root == nullptr ? "" : root->Name();
  if (tag != "sdf" && tag != "robot") {
    return fail(path.string() + ":" + std::to_string(root == nullptr ? 1 : root->GetLineNum()) +
                ": expected <sdf version=…> at the root" +
                (tag.empty() ? "" : ", found <" + std::string(tag) + ">"));
  }
  return std::unique_ptr<const SdfFile>(new SdfFile(std::move(path), std::move(document)));
}

Expected<std::unique_ptr<const SdfFile>> SdfFile::read(const fs::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto foreign = foreign_file(std::string_view(*text).substr(0, kFileHeadBytes));
  if (foreign && !text->empty()) return fail(path.string() + ": " + *foreign);
  return parse(*text, path);
}

}  // namespace canopeer
