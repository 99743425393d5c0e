#pragma once

#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace canopeer {

/// Parses `xml` and checks that its root is `<root_tag>`. The error names file and line, and says
/// how to expand a xacro file.
[[nodiscard]] Expected<void> parse_xml(const std::string& xml, const std::string& name,
                                       const char* root_tag, tinyxml2::XMLDocument& document);

/// "file:line".
[[nodiscard]] std::string xml_place(const std::string& name, const tinyxml2::XMLElement* element);

/// The element `<tag name="value">` under the root; null: none.
[[nodiscard]] const tinyxml2::XMLElement* find_named(const tinyxml2::XMLDocument& document,
                                                     const char* tag, std::string_view value);

}  // namespace canopeer
