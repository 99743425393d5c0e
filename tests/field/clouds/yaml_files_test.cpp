// Faults that YAML lets pass, in every kind of file that is YAML.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "inputs.h"
#include "program.h"

namespace canopeer {
namespace {

using test::input;

/// Each must be refused at that line, in those words, before anything is done.
struct Fault {
  const char* text;
  const char* place;
  const char* words;
};
constexpr Fault kFaults[] = {
    {"name: one\n---\nname: two\n", "bad.yaml:3", "a second document begins here"},
    {"name: one\nfx_px: 70\nname: two\n", "bad.yaml:3", "key 'name' is there twice"},
    {"name:\n\tfirst: one\n", "bad.yaml:2", "a tab indents this line"},
    {"name: &all [*all]\n", "bad.yaml:", "an alias (*name) repeats what holds it"},
};

TEST(YamlFiles, FaultsAreFoundWhereverYamlIsRead) {
  const test::TemporaryDirectory directory;
  const std::string bad = (directory / "bad.yaml").string();
  const std::string out = (directory / "out.ot").string();
  const std::vector<std::vector<std::string>> commands = {
      {"run", bad, "--out", out},
      {"robot", "check", bad, "--out", out},
      {"scene", "inspect", bad},
      {"scene", "import", bad, "--out", out},
      {"map", "fuse", input("room").string(), "--camera", bad, "--out", out},
      {"run", "smoke", "--compute-table", bad, "--out", out},
  };
  for (const Fault& fault : kFaults) {
    ASSERT_TRUE(write_file(bad, fault.text));
    for (const auto& command : commands) {
      const auto result = test::canopeer(command);
      const std::string said = command[0] + " " + command[1] + ": " + result.err;
      EXPECT_EQ(result.status, 2) << said;
      EXPECT_NE(result.err.find(fault.place), std::string::npos) << said;
      EXPECT_NE(result.err.find(fault.words), std::string::npos) << said;
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << said;
      EXPECT_FALSE(std::filesystem::exists(out)) << said;
    }
  }
}

}  // namespace
}  // namespace canopeer
