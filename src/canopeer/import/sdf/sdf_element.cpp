#include "canopeer/import/sdf/sdf_element.h"

#include <tinyxml2.h>

#include "canopeer/import/sdf/sdf_file.h"

namespace canopeer {

std::string_view SdfElement::tag() const {
  return element_ == nullptr ? std::string_view() : element_->Name();
}

std::optional<std::string> SdfElement::attribute(const char* name) const {
  const char* const value = element_ == nullptr ? nullptr : element_->Attribute(name);
  if (value == nullptr) return std::nullopt;
  return value;
}

std::string SdfElement::text() const {
  std::string text;
  if (element_ == nullptr) return text;
  for (auto* node = element_->FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToText() != nullptr) text += node->Value();
  }
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

SdfElement SdfElement::child(const char* tag) const {
  return {element_ == nullptr ? nullptr : element_->FirstChildElement(tag), file_};
}

std::vector<SdfElement> SdfElement::children() const { return children(nullptr); }

std::vector<SdfElement> SdfElement::children(const char* tag) const {
  std::vector<SdfElement> found;
  if (element_ == nullptr) return found;
  for (auto* child = element_->FirstChildElement(tag); child != nullptr;
       child = child->NextSiblingElement(tag)) {
    found.emplace_back(child, file_);
  }
  return found;
}

std::string SdfElement::where() const {
  return file_->path().string() + ":" + std::to_string(element_->GetLineNum());
}

}  // namespace canopeer
