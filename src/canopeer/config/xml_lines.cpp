#include "canopeer/config/xml_lines.h"

#include <tinyxml2.h>

namespace canopeer {
namespace {

/// What of an element is xacro, as it stands in the file; empty: nothing.
std::string xacro_of(const tinyxml2::XMLElement& element) {
  if (std::string_view(element.Name()).substr(0, 6) == "xacro:")
    return '<' + std::string(element.Name()) + '>';
  for (auto* attribute = element.FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    const std::string_view value = attribute->Value();
    if (value.find("${") != std::string_view::npos || value.find("$(") != std::string_view::npos)
      return std::string(attribute->Name()) + "=\"" + attribute->Value() + '"';
  }
  return {};
}

const tinyxml2::XMLElement* find_xacro(const tinyxml2::XMLElement* element) {
  if (!xacro_of(*element).empty()) return element;
  for (auto* child = element->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (const auto* found = find_xacro(child)) return found;
  }
  return nullptr;
}

}  // namespace

Expected<void> parse_xml(const std::string& xml, const std::string& name, const char* root_tag,
                         tinyxml2::XMLDocument& document) {
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    const int line = document.ErrorLineNum();
    return fail(name + (line > 0 ? ":" + std::to_string(line) : "") + ": malformed XML (" +
                tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID()) + ")");
  }
  const auto* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != root_tag)
    return fail(xml_place(name, root) + ": expected <" + root_tag + "> as the root element");
  if (const auto* xacro = find_xacro(root))
    return fail(xml_place(name, xacro) + ": " + xacro_of(*xacro) +
                " is xacro; expand the file first: xacro " + name + " > robot.urdf");
  return {};
}

std::string xml_place(const std::string& name, const tinyxml2::XMLElement* element) {
  return element == nullptr ? name : name + ":" + std::to_string(element->GetLineNum());
}

const tinyxml2::XMLElement* find_named(const tinyxml2::XMLDocument& document, const char* tag,
                                       std::string_view value) {
  for (auto* element = document.RootElement()->FirstChildElement(tag); element != nullptr;
       element = element->NextSiblingElement(tag)) {
    const char* named = element->Attribute("name");
    if (named != nullptr && value == named) return element;
  }
  return nullptr;
}

}  // namespace canopeer
