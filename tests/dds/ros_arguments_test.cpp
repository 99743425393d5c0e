#include "canopeer/dds/ros_arguments.h"

#include <gtest/gtest.h>

#include "support/must.h"

namespace canopeer::ros {
namespace {

std::string error_of(const std::vector<std::string>& arguments) {
  const auto parsed = RosArguments::parse(arguments);
  return parsed ? "" : parsed.error().message;
}

TEST(RosArguments, AreTakenOutOfTheCommandLine) {
  const auto parsed = must(RosArguments::parse({"run",
                                                "smoke",
                                                "--ros-args",
                                                "-r",
                                                "joint_states:=/ur/joint_states",
                                                "-r",
                                                "__ns:=/row_1",
                                                "--remap",
                                                "__node:=planner",
                                                "-p",
                                                "rate:=5.0",
                                                "--params-file",
                                                "a.yaml",
                                                "--log-level",
                                                "WARN",
                                                "--",
                                                "--site",
                                                "ros2",
                                                "--ros-args",
                                                "-p",
                                                "planner:rate:=6.0",
                                                "--disable-stdout-logs"}));
  EXPECT_EQ(parsed.rest, (std::vector<std::string>{"run", "smoke", "--site", "ros2"}));
  EXPECT_EQ(parsed.node, "planner");
  EXPECT_EQ(parsed.ns, "/row_1");
  EXPECT_EQ(parsed.parameter_files, std::vector<std::string>{"a.yaml"});
  EXPECT_EQ(parsed.log_level, "warn");
  EXPECT_EQ(parsed.settings_of("planner").at("rate"), "6.0");
  EXPECT_EQ(parsed.settings_of("other").at("rate"), "5.0");
}

TEST(RosArguments, AreAppliedToANode) {
  const auto parsed =
      must(RosArguments::parse({"--ros-args", "-r", "__node:=planner", "-r", "planner:a:=/b", "-r",
                                "other:a:=/c", "-r", "rostopic://~/d:=e"}));
  NodeOptions options;
  options.remaps = {{"a", "/before"}};
  parsed.apply(options);
  EXPECT_EQ(options.name, "planner");
  EXPECT_EQ(options.ns, "/");
  EXPECT_EQ(options.remaps, (std::map<std::string, std::string>{{"a", "/b"}, {"~/d", "e"}}));
}

TEST(RosArguments, SayWhichArgumentIsWrong) {
  EXPECT_EQ(error_of({"--ros-args", "-r", "a=b"}), "--ros-args -r: 'a=b' is not like 'from:=to'");
  EXPECT_EQ(error_of({"--ros-args", "-r"}), "--ros-args: -r needs a value");
  EXPECT_NE(error_of({"--ros-args", "-x", "y"}).find("'-x' is unknown"), std::string::npos);
  EXPECT_NE(error_of({"--ros-args", "-r", "a:=1b"}).find("'1b'"), std::string::npos);
  EXPECT_NE(error_of({"--ros-args", "-r", "__ns:=row"}).find("namespace 'row'"), std::string::npos);
  EXPECT_NE(error_of({"--ros-args", "--log-level", "loud"}).find("'loud'"), std::string::npos);
  EXPECT_EQ(error_of({"--ros-args"}), "");
}

TEST(RosArguments, TheDomainIsANumber) {
  EXPECT_EQ(must(domain_from("")), std::nullopt);
  EXPECT_EQ(must(domain_from("42")), 42);
  for (const char* wrong : {"233", "-1", "4x", " 4"}) EXPECT_FALSE(domain_from(wrong)) << wrong;
}

}  // namespace
}  // namespace canopeer::ros
