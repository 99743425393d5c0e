#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "canopeer/base/text_lines.h"
#include "program.h"

// The program among others: in pipes, in the manual, behind the tabulator key.

namespace canopeer {
namespace {

const std::string kProgram = CANOPEER_PROGRAM;
const std::string kCompletion = CANOPEER_SOURCE_DIR "/apps/canopeer/completion/";

/// What a command prints on both streams, in the order in which it comes out of a pipe.
std::string piped(const std::string& command) {
  std::string text;
  std::FILE* const pipe =
      popen(("cd " CANOPEER_SOURCE_DIR "; (" + command + ") 2>&1").c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

bool there_is(const std::string& tool) { return !piped("command -v " + tool).empty(); }

/// What bash would offer behind these words; the last one is unfinished.
std::vector<std::string> offered(const std::string& words, int last) {
  const std::string text =
      piped("bash --norc -c 'source " + kCompletion + "canopeer.bash; COMP_WORDS=(" + kProgram +
            " " + words + "); COMP_CWORD=" + std::to_string(last) +
            "; _canopeer; printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
  std::vector<std::string> lines;
  for (const std::string_view line : words_of(text, "\n")) lines.emplace_back(line);
  return lines;
}

bool among(const std::vector<std::string>& all, const std::string& one) {
  return std::count(all.begin(), all.end(), one) == 1;
}

using Offers = std::vector<std::string>;

TEST(Shell, WhatWasPrintedStandsBeforeTheErrorThatFollows) {
  const std::string text = piped("CANOPEER_DATA=/nowhere " + kProgram + " doctor --quick");
  const auto error = text.find("canopeer: /nowhere: has no missions");
  ASSERT_NE(error, std::string::npos) << text;
  EXPECT_LT(text.find("planners"), error) << text;
  EXPECT_EQ(text.find('\n', error), text.size() - 1) << text;
}

TEST(Shell, FilesOfTheProgramMayLieElsewhere) {
  const test::TemporaryDirectory folder;
  const std::string missions = (folder / "missions").string();
  piped("mkdir " + missions + "; cp missions/smoke.yaml " + missions + "/my_own.yaml");
  const std::string text =
      piped("CANOPEER_DATA=" + (folder / "").string() + " " + kProgram + " doctor --quick");
  EXPECT_NE(text.find("missions       my_own\n"), std::string::npos) << text;
}

TEST(Shell, AFolderOfTheSameNameHidesNoMission) {
  const test::TemporaryDirectory folder;
  const std::string text = piped("cd " + (folder / "").string() + "; mkdir smoke; " + kProgram +
                                 " scene inspect smoke --counts");
  EXPECT_NE(text.find("fruits"), std::string::npos) << text;
}

TEST(Shell, CommandsAndOptionsAreCompleted) {
  EXPECT_EQ(offered("ru", 1), (Offers{"run"}));
  EXPECT_TRUE(among(offered("\"\"", 1), "doctor"));
  EXPECT_EQ(offered("scene r", 2), (Offers{"render"}));
  EXPECT_EQ(offered("run --plan", 2), (Offers{"--planner"}));
  EXPECT_EQ(offered("map fuse --stri", 3), (Offers{"--strict"}));
  EXPECT_EQ(offered("manual ca", 2), (Offers{"calibrate"}));
}

TEST(Shell, ShippedMissionsAndFilesAreCompleted) {
  EXPECT_EQ(offered("run smok", 2), (Offers{"smoke", "smoke_rail"}));
  EXPECT_EQ(offered("run missions/smoke_", 2), (Offers{"missions/smoke_rail.yaml"}));
  EXPECT_EQ(offered("bench smoke dense_", 3), (Offers{"dense_1", "dense_2"}));
  EXPECT_EQ(offered("run --seed 3 smoke_", 4), (Offers{"smoke_rail"}));
  EXPECT_EQ(offered("scene render smoke_", 3), (Offers{"smoke_rail"}));
  EXPECT_TRUE(among(offered("map info READ", 3), "README.md"));
}

TEST(Shell, ValuesThatMayBeNamedAreCompleted) {
  EXPECT_TRUE(among(offered("run smoke --planner v", 4), "vmp_released"));
  EXPECT_EQ(offered("run --site = si", 4), (Offers{"simulation"}));
  EXPECT_EQ(offered("bench smoke --planners vmp,ran", 4), (Offers{"vmp,random"}));
  EXPECT_EQ(offered("fruit fit --unit \"\"", 4), (Offers{"m", "cm", "mm"}));
  EXPECT_EQ(offered("run smoke --compute-table ref", 4), (Offers{"reference"}));
  EXPECT_EQ(offered("run smoke --seed \"\"", 4), Offers{});
}

TEST(Shell, EachCommandHasAManualPageThatGroffReadsWithoutComplaint) {
  const test::TemporaryDirectory folder;
  const std::string all = (folder / "man").string();
  ASSERT_EQ(test::canopeer({"manual", "--all", all}).status, 0);
  const std::string pages = piped("cd " + all + "/man1; ls");
  for (const char* page : {"canopeer.1\n", "canopeer-run.1\n", "canopeer-map.1\n"}) {
    EXPECT_NE(pages.find(page), std::string::npos) << pages;
  }
  if (!there_is("groff")) GTEST_SKIP() << "no groff";
  EXPECT_EQ(piped("for page in " + all + "/man1/*; do groff -man -Tutf8 -ww -z $page; done"), "");
}

TEST(Shell, AManualPageHasEveryOptionOfItsCommand) {
  const std::string page = test::canopeer({"manual", "scene"}).out;
  for (const char* part : {"canopeer scene import", "\\-\\-min\\-fruit\\-cm3", ".SH EXIT STATUS"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  const auto unknown = test::canopeer({"manual", "fly"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("no command 'fly'"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace canopeer
