#include "canopeer/dds/names.h"

#include <gtest/gtest.h>

#include "support/must.h"

namespace canopeer::ros {
namespace {

const NodeName kPlanner{"/row_1", "planner"};

TEST(Names, AreExpandedAsRosDoes) {
  EXPECT_EQ(must(expand_name("joint_states", kPlanner)), "/row_1/joint_states");
  EXPECT_EQ(must(expand_name("/joint_states", kPlanner)), "/joint_states");
  EXPECT_EQ(must(expand_name("~/start", kPlanner)), "/row_1/planner/start");
  EXPECT_EQ(must(expand_name("~", kPlanner)), "/row_1/planner");
  EXPECT_EQ(must(expand_name("{node}/a", kPlanner)), "/row_1/planner/a");
  EXPECT_EQ(must(expand_name("{ns}/a", kPlanner)), "/row_1/a");
  EXPECT_EQ(must(expand_name("a", {"/", "planner"})), "/a");
  EXPECT_EQ(must(expand_name("~/a", {"/", "planner"})), "/planner/a");
}

TEST(Names, ThatRosRefusesAreRefused) {
  for (const char* wrong : {"", "/", "a b", "a//b", "a/", "1a", "a/1b", "~a", "a/~", "ä", "a-b",
                            "{unknown}/a", "//a"}) {
    EXPECT_FALSE(expand_name(wrong, kPlanner)) << wrong;
  }
  for (const char* wrong : {"", "1", "a/b", "a.b"}) EXPECT_FALSE(check_node_name(wrong)) << wrong;
  for (const char* wrong : {"", "a", "/a/", "/1"}) EXPECT_FALSE(check_namespace(wrong)) << wrong;
}

TEST(Names, AreRemappedOnceByWhatTheyExpandTo) {
  const std::map<std::string, std::string> remaps = {
      {"camera/color", "/left/color"}, {"~/start", "/go"}, {"/left/color", "/wrong"}};
  EXPECT_EQ(must(resolve_name("/row_1/camera/color", kPlanner, remaps)), "/left/color");
  EXPECT_EQ(must(resolve_name("~/start", kPlanner, remaps)), "/go");
  EXPECT_EQ(must(resolve_name("/camera/color", kPlanner, remaps)), "/camera/color");
}

}  // namespace
}  // namespace canopeer::ros
