#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "source_tree.h"

namespace canopeer {
namespace {

using testing_support::lines_of;
using testing_support::source_files;
using testing_support::source_root;

/// "Suite.Name" of every test in the tree.
std::set<std::string> all_tests() {
  static const std::regex test(R"(^TEST(?:_[FP])?\((\w+),\s*(\w+)\))");
  std::set<std::string> names;
  for (const auto& file : source_files("tests")) {
    for (const std::string& line : lines_of(file)) {
      std::smatch match;
      if (std::regex_search(line, match, test)) names.insert(match[1].str() + "." + match[2].str());
    }
  }
  return names;
}

// Each step of docs/method.md is a row: step | source | function | test.
TEST(MethodDocument, EveryStepNamesTestsThatExist) {
  static const std::regex name(R"(`(\w+)\.(\w+|\*)`)");
  const auto tests = all_tests();
  int steps = 0;
  for (const std::string& line : lines_of(source_root() / "docs/method.md")) {
    if (!line.starts_with("| ") || line.starts_with("| step")) continue;
    ++steps;
    const std::string column = line.substr(line.rfind('|', line.size() - 2) + 1);
    int named = 0;
    for (std::sregex_iterator it(column.begin(), column.end(), name), end; it != end; ++it) {
      ++named;
      const std::string suite = (*it)[1].str() + ".";
      const std::string full = suite + (*it)[2].str();
      const auto next = tests.lower_bound(suite);
      const bool found =
          (*it)[2] == "*" ? next != tests.end() && next->starts_with(suite) : tests.contains(full);
      EXPECT_TRUE(found) << "no test " << full << " for: " << line;
    }
    EXPECT_GT(named, 0) << "no test named for: " << line;
  }
  EXPECT_GT(steps, 20);
}

}  // namespace
}  // namespace canopeer
