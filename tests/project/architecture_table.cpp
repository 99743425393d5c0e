#include "architecture_table.h"

#include <gtest/gtest.h>

#include <regex>
#include <vector>

#include "source_tree.h"

namespace canopeer::testing_support {
namespace {

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  return {std::sregex_token_iterator(text.begin(), text.end(), regex),
          std::sregex_token_iterator()};
}

std::vector<std::string> words_of(const std::string& text) {
  return matches(text, "[a-z][a-z0-9_]*");
}

/// The cells of the table under a heading of ARCHITECTURE.md, without its head.
std::vector<std::vector<std::string>> rows_under(const std::string& heading) {
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (const std::string& line : lines_of(source_root() / "ARCHITECTURE.md")) {
    if (line.rfind("## ", 0) == 0) inside = line == "## " + heading;
    if (inside && line.rfind("| ", 0) == 0) rows.push_back(matches(line, "[^|]+"));
  }
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

void reach(const Allowed& allowed, const std::string& name, std::set<std::string>& reached) {
  const auto found = allowed.find(name);
  if (found == allowed.end()) return;
  for (const std::string& next : found->second) {
    if (reached.insert(next).second) reach(allowed, next, reached);
  }
}

}  // namespace

Allowed module_table() {
  Allowed allowed;
  for (const auto& row : rows_under("Modules")) {
    const std::vector<std::string> others = words_of(row.at(2));
    allowed[words_of(row.at(0)).at(0)].insert(others.begin(), others.end());
  }
  return allowed;
}

Allowed room_table() {
  Allowed allowed;
  for (const auto& row : rows_under("Rooms")) {
    const std::string module = words_of(row.at(0)).at(0) + "/";
    std::set<std::string>& others = allowed[module + words_of(row.at(1)).at(0)];
    for (const std::string& other : words_of(row.at(3))) others.insert(module + other);
  }
  return allowed;
}

std::set<std::string> open_rooms() {
  std::set<std::string> rooms;
  for (const auto& row : rows_under("Rooms")) {
    if (row.at(1).find("(open)") == std::string::npos) continue;
    rooms.insert(words_of(row.at(0)).at(0) + "/" + words_of(row.at(1)).at(0));
  }
  return rooms;
}

Allowed closure(const Allowed& allowed) {
  Allowed closed;
  for (const auto& [name, direct] : allowed) reach(allowed, name, closed[name]);
  return closed;
}

void expect_one_way(const Allowed& allowed) {
  for (const auto& [name, reached] : closure(allowed)) {
    EXPECT_EQ(reached.count(name), 0U) << name << " reaches itself";
    for (const std::string& other : reached) EXPECT_EQ(allowed.count(other), 1U) << other;
  }
}

std::set<std::string> names_of(const Allowed& allowed) {
  std::set<std::string> names;
  for (const auto& [name, direct] : allowed) names.insert(name);
  return names;
}

Place place_of(const std::string& header) {
  static const std::regex address("^canopeer/([a-z][a-z0-9]*)(/.+)?/[^/]+$");
  std::smatch match;
  if (!std::regex_match(header, match, address)) return {};
  const std::string module = match[1].str();
  return {module, match[2].length() == 0 ? std::string() : module + match[2].str()};
}

}  // namespace canopeer::testing_support
