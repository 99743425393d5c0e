#include <gtest/gtest.h>

#include "architecture_table.h"
#include "source_tree.h"

namespace canopeer {
namespace {

using testing_support::Allowed;
using testing_support::closure;
using testing_support::IncludeLine;
using testing_support::includes_under;
using testing_support::module_table;
using testing_support::names_of;
using testing_support::place_of;
using testing_support::source_root;

std::set<std::string> module_directories() {
  std::set<std::string> modules;
  for (const auto& entry : std::filesystem::directory_iterator(source_root() / "src/canopeer")) {
    if (entry.is_directory()) modules.insert(entry.path().filename().string());
  }
  return modules;
}

TEST(Architecture, TableNamesExactlyTheModulesThatExist) {
  EXPECT_EQ(names_of(module_table()), module_directories());
}

TEST(Architecture, TableHasNoCyclesAndNoUnknownNames) {
  testing_support::expect_one_way(module_table());
}

TEST(Architecture, EveryIncludeIsAllowedByTheTable) {
  const Allowed closed = closure(module_table());
  for (const auto& [module, reached] : closed) {
    for (const IncludeLine& include : includes_under("src/canopeer/" + module)) {
      const std::string other = place_of(include.header).module;
      if (other.empty() || other == module) continue;
      EXPECT_EQ(reached.count(other), 1U)
          << include.where() << ": " << module << " must not include " << include.header;
    }
  }
}

TEST(Architecture, OwnHeadersAreIncludedByTheirAddress) {
  for (const IncludeLine& include : includes_under("src/canopeer")) {
    if (!include.quoted) continue;
    EXPECT_FALSE(place_of(include.header).module.empty())
        << include.where() << ": write \"canopeer/<module>/…\", not \"" << include.header << '"';
  }
}

TEST(Architecture, WhatRunsOnARealRobotKnowsNoGroundTruth) {
  const Allowed closed = closure(module_table());
  const auto mission = closed.find("mission");
  ASSERT_NE(mission, closed.end());
  for (const char* hidden : {"scene", "render", "sim", "eval"}) {
    EXPECT_EQ(mission->second.count(hidden), 0U) << "mission reaches " << hidden;
  }
}

TEST(Architecture, ApplicationsIncludeModulesThatExist) {
  const std::set<std::string> modules = module_directories();
  for (const IncludeLine& include : includes_under("apps")) {
    const std::string module = place_of(include.header).module;
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
