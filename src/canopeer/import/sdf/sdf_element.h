#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}

namespace canopeer {

class SdfFile;

struct SdfVersion {
  int major = 1;
  int minor = 0;

  friend auto operator<=>(const SdfVersion&, const SdfVersion&) = default;
};

/// An element of an SDF file, or none. It points into its file, which must outlive it.
class SdfElement {
 public:
  SdfElement() = default;
  SdfElement(const tinyxml2::XMLElement* element, const SdfFile* file)
      : element_(element), file_(file) {}

  explicit operator bool() const { return element_ != nullptr; }

  // Of no element all that follows is empty, too.

  [[nodiscard]] std::string_view tag() const;
  [[nodiscard]] std::optional<std::string> attribute(const char* name) const;
  /// The attribute "name"; empty: it has none.
  [[nodiscard]] std::string name() const { return attribute("name").value_or(""); }
  /// What stands between its tags, without children, comments, and blanks around it.
  [[nodiscard]] std::string text() const;

  /// The first child with this tag.
  [[nodiscard]] SdfElement child(const char* tag) const;
  [[nodiscard]] std::vector<SdfElement> children() const;
  [[nodiscard]] std::vector<SdfElement> children(const char* tag) const;

  /// Of an element only.
  [[nodiscard]] const SdfFile& file() const { return *file_; }
  /// "file:line".
  [[nodiscard]] std::string where() const;

 private:
  const tinyxml2::XMLElement* element_ = nullptr;
  const SdfFile* file_ = nullptr;
};

}  // namespace canopeer
