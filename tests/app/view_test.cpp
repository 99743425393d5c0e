#include <gtest/gtest.h>

#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;
using test::canopeer;
using test::TemporaryDirectory;

bool page_is_built_in() {
  return canopeer({"doctor", "--quick"}).out.find("live view      built in") != std::string::npos;
}

test::ProgramResult run_smoke(const fs::path& out, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"run", "smoke", "--quiet",   "--time-per-segment",
                                    "4",   "--out", out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return canopeer(words);
}

TEST(ViewCommand, ARunLeavesAReplayThatChangesNothingElse) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_smoke(folder / "with").status, 0);
  ASSERT_EQ(run_smoke(folder / "without", {"--no-replay"}).status, 0);
  EXPECT_TRUE(fs::exists(folder / "with" / "replay"));
  EXPECT_FALSE(fs::exists(folder / "without" / "replay"));
  for (const char* file : {"record", "fruits.csv", "timeline.csv", "map.ot"}) {
    EXPECT_EQ(*read_file(folder / "with" / file), *read_file(folder / "without" / file)) << file;
  }
  EXPECT_NE(read_file(folder / "with" / "report.html")->find("8765/#t="), std::string::npos);
  EXPECT_EQ(read_file(folder / "without" / "report.html")->find("8765/#t="), std::string::npos);
}

TEST(ViewCommand, ARunSaysWhatBecameOfFramesOnTheWay) {
  const TemporaryDirectory folder;
  const auto run = canopeer({"run", "smoke", "--time-per-segment", "3", "--set",
                             "frames.on_the_way_hz=5", "--out", (folder / "run").string()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("\non the way        "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(" frames taken in, "), std::string::npos) << run.out;
  EXPECT_NE(run.err.find(" on the way  "), std::string::npos) << run.err;
  const std::string page = *read_file(folder / "run" / "report.html");
  EXPECT_NE(page.find("<h2>Frames on the way</h2>"), std::string::npos);
  const auto without = canopeer({"run", "smoke", "--time-per-segment", "1", "--no-replay", "--out",
                                 (folder / "without").string()});
  EXPECT_EQ(without.out.find("on the way"), std::string::npos);
}

TEST(ViewCommand, WatchingChangesNothingEither) {
  if (!page_is_built_in()) GTEST_SKIP() << "built without Node";
  const TemporaryDirectory folder;
  ASSERT_EQ(run_smoke(folder / "alone").status, 0);
  const auto watched = run_smoke(folder / "watched", {"--view", "--view-port", "0"});
  ASSERT_EQ(watched.status, 0);
  EXPECT_NE(watched.err.find("canopeer: watch at http://127.0.0.1:"), std::string::npos);
  EXPECT_EQ(*read_file(folder / "alone" / "record"), *read_file(folder / "watched" / "record"));
}

TEST(ViewCommand, ShowsARunAlsoOneWhoseReplayWasCutOff) {
  if (!page_is_built_in()) GTEST_SKIP() << "built without Node";
  const TemporaryDirectory folder;
  ASSERT_EQ(run_smoke(folder / "run").status, 0);
  const std::vector<std::string> words = {"view", (folder / "run").string(), "--view-port", "0"};
  const auto whole = test::canopeer_interrupted_when_it_speaks(words);
  EXPECT_EQ(whole.status, 0);
  EXPECT_NE(whole.out.find("http://127.0.0.1:"), std::string::npos);
  EXPECT_NE(whole.out.find("/?token="), std::string::npos);
  fs::resize_file(folder / "run" / "replay", fs::file_size(folder / "run" / "replay") - 100);
  const auto cut = test::canopeer_interrupted_when_it_speaks(words);
  EXPECT_EQ(cut.status, 0);
  EXPECT_NE(cut.err.find("the end of the replay is damaged"), std::string::npos);
}

TEST(ViewCommand, SaysWhatItCannotShow) {
  if (!page_is_built_in()) GTEST_SKIP() << "built without Node";
  const TemporaryDirectory folder;
  const auto none = canopeer({"view", (folder / "nowhere").string()});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("no such directory"), std::string::npos);
  ASSERT_EQ(run_smoke(folder / "run", {"--no-replay"}).status, 0);
  const auto without = canopeer({"view", (folder / "run").string()});
  EXPECT_EQ(without.status, 2);
  EXPECT_NE(without.err.find("--no-replay"), std::string::npos);
  ASSERT_TRUE(write_file(folder / "run" / "replay", "not a replay").has_value());
  EXPECT_EQ(canopeer({"view", (folder / "run").string()}).status, 2);
}

}  // namespace
}  // namespace canopeer
