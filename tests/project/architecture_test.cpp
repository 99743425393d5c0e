#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "source_tree.h"

namespace canopeer {
namespace {

using testing_support::IncludeLine;
using testing_support::includes_under;
using testing_support::lines_of;
using testing_support::source_root;

/// Module → modules it may include.
using Allowed = std::map<std::string, std::set<std::string>>;

std::vector<std::string> words_of(const std::string& text) {
  static const std::regex word("[a-z]+");
  std::vector<std::string> words;
  for (std::sregex_iterator it(text.begin(), text.end(), word), end; it != end; ++it) {
    words.push_back(it->str());
  }
  return words;
}

/// The rows `| module | one line | may include |` under the heading "Modules" of ARCHITECTURE.md.
Allowed table() {
  static const std::regex row(R"(^\| *([a-z]+) *\|[^|]*\|([^|]*)\| *$)");
  Allowed allowed;
  bool inside = false;
  for (const std::string& line : lines_of(source_root() / "ARCHITECTURE.md")) {
    if (line.rfind("## ", 0) == 0) inside = line.rfind("## Modules", 0) == 0;
    std::smatch match;
    if (!inside || !std::regex_match(line, match, row) || match[1] == "module") continue;
    const std::vector<std::string> modules = words_of(match[2].str());
    allowed[match[1].str()].insert(modules.begin(), modules.end());
  }
  return allowed;
}

void reach(const Allowed& allowed, const std::string& module, std::set<std::string>& reached) {
  const auto found = allowed.find(module);
  if (found == allowed.end()) return;
  for (const std::string& next : found->second) {
    if (reached.insert(next).second) reach(allowed, next, reached);
  }
}

/// The table with "may include" followed through.
Allowed closure(const Allowed& allowed) {
  Allowed closed;
  for (const auto& [module, direct] : allowed) reach(allowed, module, closed[module]);
  return closed;
}

std::set<std::string> module_directories() {
  std::set<std::string> modules;
  for (const auto& entry : std::filesystem::directory_iterator(source_root() / "src/canopeer")) {
    if (entry.is_directory()) modules.insert(entry.path().filename().string());
  }
  return modules;
}

/// "map" of "canopeer/map/voxel_map.h"; empty for anything else.
std::string module_of(const std::string& header) {
  static const std::regex address("^canopeer/([a-z]+)/.+");
  std::smatch match;
  return std::regex_match(header, match, address) ? match[1].str() : std::string();
}

TEST(Architecture, TableNamesExactlyTheModulesThatExist) {
  std::set<std::string> named;
  for (const auto& [module, direct] : table()) named.insert(module);
  EXPECT_EQ(named, module_directories());
}

TEST(Architecture, TableHasNoCyclesAndNoUnknownNames) {
  const Allowed allowed = table();
  for (const auto& [module, reached] : closure(allowed)) {
    EXPECT_EQ(reached.count(module), 0U) << module << " reaches itself";
    for (const std::string& other : reached) EXPECT_EQ(allowed.count(other), 1U) << other;
  }
}

TEST(Architecture, EveryIncludeIsAllowedByTheTable) {
  const Allowed closed = closure(table());
  for (const auto& [module, reached] : closed) {
    for (const IncludeLine& include : includes_under("src/canopeer/" + module)) {
      const std::string other = module_of(include.header);
      if (other.empty() || other == module) continue;
      EXPECT_EQ(reached.count(other), 1U)
          << include.where() << ": " << module << " must not include " << include.header;
    }
  }
}

TEST(Architecture, OwnHeadersAreIncludedByTheirAddress) {
  for (const IncludeLine& include : includes_under("src/canopeer")) {
    if (!include.quoted) continue;
    EXPECT_FALSE(module_of(include.header).empty())
        << include.where() << ": write \"canopeer/<module>/…\", not \"" << include.header << '"';
  }
}

TEST(Architecture, WhatRunsOnARealRobotKnowsNoGroundTruth) {
  const Allowed closed = closure(table());
  const auto mission = closed.find("mission");
  ASSERT_NE(mission, closed.end());
  for (const char* hidden : {"scene", "render", "sim", "eval"}) {
    EXPECT_EQ(mission->second.count(hidden), 0U) << "mission reaches " << hidden;
  }
}

TEST(Architecture, ApplicationsIncludeModulesThatExist) {
  const std::set<std::string> modules = module_directories();
  for (const IncludeLine& include : includes_under("apps")) {
    const std::string module = module_of(include.header);
    if (!module.empty()) {
      EXPECT_EQ(modules.count(module), 1U) << include.where();
    }
  }
}

TEST(Architecture, HeadersAnAdapterNeedsAreThere) {
  for (const char* header :
       {"sensing/rgbd_frame.h", "sensing/camera_intrinsics.h", "sensing/image.h",
        "sensing/point_cloud.h", "mission/ports.h", "record/run_record.h"}) {
    EXPECT_TRUE(std::filesystem::exists(source_root() / "src/canopeer" / header)) << header;
  }
}

}  // namespace
}  // namespace canopeer
