#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "source_tree.h"

// What people read leads where it says.

namespace canopeer {
namespace {

namespace fs = std::filesystem;

using testing_support::lines_of;
using testing_support::source_root;

std::string text_of(const fs::path& file) {
  std::string text;
  for (const std::string& line : lines_of(file)) text += line + '\n';
  return text;
}

TEST(Texts, EveryDecisionIsListedByTopic) {
  const fs::path folder = source_root() / "docs/decisions";
  const std::string list = text_of(folder / "README.md");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    EXPECT_NE(list.find('(' + name + ')'), std::string::npos) << name;
  }
}

TEST(Texts, EveryExampleIsShortAndNamedInTheReadme) {
  const std::string readme = text_of(source_root() / "README.md");
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(source_root() / "examples")) {
    if (entry.path().extension() != ".cpp") continue;
    EXPECT_LT(lines_of(entry.path()).size(), 80U) << entry.path();
    EXPECT_NE(readme.find(entry.path().filename().string()), std::string::npos) << entry.path();
    ++examples;
  }
  EXPECT_GE(examples, 5);
}

TEST(Texts, LinksToFilesLeadSomewhere) {
  static const std::regex kLink(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  for (const char* place : {".", "docs", "docs/decisions"}) {
    for (const auto& entry : fs::directory_iterator(source_root() / place)) {
      if (entry.path().extension() != ".md") continue;
      const std::string text = text_of(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), kLink), end; it != end; ++it) {
        const fs::path target = entry.path().parent_path() / (*it)[1].str();
        EXPECT_TRUE(fs::exists(target)) << entry.path() << ": " << (*it)[1];
      }
    }
  }
}

}  // namespace
}  // namespace canopeer
