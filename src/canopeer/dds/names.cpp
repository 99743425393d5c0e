#include "canopeer/dds/names.h"

#include <algorithm>
#include <cctype>

namespace canopeer::ros {
namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_token(const std::string& text) {
  return !text.empty() && !is_digit(text.front()) &&
         std::all_of(text.begin(), text.end(), is_letter);
}

/// "/a/b": tokens, each after a slash.
bool is_absolute(const std::string& name) {
  if (name.empty() || name.front() != '/') return false;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find('/', at + 1), name.size());
    if (!is_token(name.substr(at + 1, end - at - 1))) return false;
    at = end;
  }
  return true;
}

std::string below(const std::string& ns, const std::string& name) {
  return ns == "/" ? "/" + name : ns + "/" + name;
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
}

}  // namespace

bool is_short_name(const std::string& name) {
  constexpr std::size_t kLongest = 256;
  return !name.empty() && name.size() <= kLongest;
}

Expected<void> check_node_name(const std::string& name) {
  if (is_token(name)) return {};
  return fail("node name '" + name + "': letters, digits and '_' only, no digit in front");
}

Expected<void> check_namespace(const std::string& ns) {
  if (ns == "/" || is_absolute(ns)) return {};
  return fail("namespace '" + ns + "': must be '/' or like '/row_1/left', of letters, digits, '_'");
}

std::string NodeName::full() const { return below(ns, name); }

Expected<std::string> expand_name(const std::string& name, const NodeName& node) {
  std::string text = name;
  replace_all(text, "{node}", node.name);
  replace_all(text, "{namespace}", node.ns == "/" ? "" : node.ns);
  replace_all(text, "{ns}", node.ns == "/" ? "" : node.ns);
  if (text == "~") {
    text = node.full();
  } else if (text.starts_with("~/")) {
    text = node.full() + text.substr(1);
  } else if (!text.starts_with("/")) {
    text = below(node.ns, text);
  }
  if (is_absolute(text)) return text;
  return fail("name '" + name +
              "': tokens of letters, digits and '_', parted by single '/', no digit in front of "
              "any, '~/' only at the beginning");
}

Expected<std::string> resolve_name(const std::string& name, const NodeName& node,
                                   const std::map<std::string, std::string>& remaps) {
  auto expanded = expand_name(name, node);
  if (!expanded) return expanded;
  for (const auto& [from, to] : remaps) {
    const auto left = expand_name(from, node);
    if (left && *left == *expanded) return expand_name(to, node);
  }
  return expanded;
}

}  // namespace canopeer::ros
