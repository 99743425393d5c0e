#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/mission/steering_desk.h"
#include "canopeer/run/run.h"

extern char** environ;

// A run is cut between two steps and goes on in another process: nobody must be able to tell.

namespace canopeer {
namespace {

namespace fs = std::filesystem;

const fs::path kMission = CANOPEER_SOURCE_DIR "/missions/smoke.yaml";

/// Runs the helper program; its exit status.
int run_in_parts(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {CANOPEER_EMULATOR, RUN_IN_PARTS};
  if (words.front().empty()) words.erase(words.begin());
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) return -1;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string content(const fs::path& file) {
  auto bytes = read_file(file);
  if (!bytes) return "cannot read " + file.string();
  // The one figure that depends on the machine.
  const std::size_t wall = bytes->find("\"wall_time_s\"");
  if (file.filename() == "summary.json" && wall != std::string::npos) {
    bytes->erase(wall, bytes->find('\n', wall) - wall);
  }
  return *bytes;
}

class RunStateTest : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    directory_ =
        fs::temp_directory_path() / ("canopeer_run_state_" + GetParam() + std::to_string(getpid()));
    fs::remove_all(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  int part(const std::string& out, const std::string& steps) {
    return run_in_parts({kMission.string(), (directory_ / out).string(), GetParam(), steps,
                         (directory_ / (out + ".state")).string()});
  }

  fs::path directory_;
};

TEST_P(RunStateTest, CutAnywhereItGoesOnInANewProcessWithTheSameBytes) {
  ASSERT_EQ(part("whole", "0"), 0);
  ASSERT_EQ(part("whole", "go-on"), 0);
  int cuts = 0;
  // Before and behind the first frame, then in the middle of both segments and between them.
  std::vector<int> places = {1, 2, 3, 5, 9, 16};
  if (GetParam() == "vmp") places.insert(places.end(), {4, 7, 12, 22, 30, 45});
  for (const int steps : places) {
    SCOPED_TRACE("cut after " + std::to_string(steps) + " steps");
    const std::string out = "cut_" + std::to_string(steps);
    const int status = part(out, std::to_string(steps));
    if (status == 3) continue;  // it has fewer steps
    ASSERT_EQ(status, 0);
    ASSERT_EQ(part(out, "go-on"), 0);
    for (const char* file : {"record", "summary.json", "fruits.csv", "fruits.json", "timeline.csv",
                             "map.ot", "map_roi.ot", "fruits.ply"}) {
      EXPECT_TRUE(content(directory_ / "whole" / file) == content(directory_ / out / file)) << file;
    }
    ++cuts;
  }
  EXPECT_GE(cuts, 4);
}

INSTANTIATE_TEST_SUITE_P(EveryPlanner, RunStateTest,
                         ::testing::Values("vmp", "rvp", "random", "coverage", "vmp_released",
                                           "nbs", "nbv", "vmp_true", "vmp_on_the_way",
                                           "drive_by_on_the_way"),
                         [](const auto& param) { return param.param; });

/// A short run up to some step, in this process.
std::unique_ptr<Run> begun(const fs::path& out, int steps, const std::string& seed = "1") {
  static const RunRegistries kRegistries = RunRegistries::built_in();
  StageRequest request;
  request.mission = kMission;
  request.overrides = {{"time_per_segment_s", "3"}, {"seed", seed}};
  request.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  auto run = std::move(Run::compose(request, kRegistries, out).value());
  if (steps > 0) {
    EXPECT_TRUE(run->begin().has_value());
  }
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(run->step());
  return run;
}

class RunStateFile : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove_all(directory_); }
  fs::path directory_ =
      fs::temp_directory_path() /
      ("canopeer_run_state_" +
       std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
       std::to_string(getpid()));
};

TEST_F(RunStateFile, TwoCopiesOfAStateGoOnAlikeInOneProcess) {
  const auto run = begun(directory_ / "a", 4);
  const RunState state = run->state().value();
  RunState copy = state;
  while (run->step()) {
  }
  ASSERT_TRUE(run->finish().has_value());
  const std::string expected = content(directory_ / "a" / "record");
  const auto again = begun(directory_ / "a", 0);
  ASSERT_TRUE(again->resume(std::move(copy)).has_value());
  while (again->step()) {
  }
  ASSERT_TRUE(again->finish().has_value());
  EXPECT_TRUE(content(directory_ / "a" / "record") == expected);
}

TEST_F(RunStateFile, IsTheSameForTheSameStateAndReadsBackTheSame) {
  const auto run = begun(directory_ / "a", 5);
  const fs::path file = directory_ / "state";
  ASSERT_TRUE(write_run_state(file, run->state().value()).has_value());
  const auto read = read_run_state(file, run->file().mission);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const fs::path again = directory_ / "state_again";
  ASSERT_TRUE(write_run_state(again, *read).has_value());
  EXPECT_TRUE(content(file) == content(again));
}

TEST_F(RunStateFile, OfAnotherRunIsRefusedByName) {
  const RunState state = begun(directory_ / "a", 4)->state().value();
  const auto other = begun(directory_ / "a", 0, "2");
  const auto outcome = other->resume(state);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("smoke vmp seed 1, canopeer"), std::string::npos)
      << outcome.error().message;
}

TEST_F(RunStateFile, AnotherRunsRecordIsNotTouched) {
  RunState state = begun(directory_ / "a", 2)->state().value();
  static_cast<void>(begun(directory_ / "b", 5, "2"));
  const std::string before = content(directory_ / "b" / "record");
  const auto run = begun(directory_ / "b", 0);
  const auto outcome = run->resume(std::move(state));
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("is of another run"), std::string::npos);
  EXPECT_TRUE(content(directory_ / "b" / "record") == before);
  EXPECT_FALSE(run->begin().has_value());
}

TEST_F(RunStateFile, AfterAStopTheRunThatGoesOnEndsTheSameWay) {
  SteeringPolicy policy("rain", [](const SteeringPoint& at) {
    return at.views >= 2 ? SteeringWord::Kind::stop : SteeringWord::Kind::go_on;
  });
  const auto finish = [&](canopeer::Run& run) {
    while (run.step()) {
    }
    EXPECT_TRUE(run.finish().has_value());
    EXPECT_TRUE(run.interrupted());
    return content(directory_ / "a" / "record");
  };
  std::vector<RunState> states;
  std::string expected;
  {
    const auto run = begun(directory_ / "a", 0);
    run->steer(policy);
    ASSERT_TRUE(run->begin().has_value());
    states.push_back(run->state().value());
    while (run->step()) states.push_back(run->state().value());
    states.push_back(run->state().value());  // all steps are done
    ASSERT_TRUE(run->finish().has_value());
    expected = content(directory_ / "a" / "record");
  }
  for (std::size_t i = states.size(); i-- > 0;) {
    SCOPED_TRACE("state " + std::to_string(i));
    const auto run = begun(directory_ / "a", 0);
    run->steer(policy);
    ASSERT_TRUE(run->resume(states[i]).has_value());
    EXPECT_TRUE(finish(*run) == expected);
  }
}

TEST_F(RunStateFile, DamagedOrForeignIsRefusedWithItsName) {
  const auto run = begun(directory_ / "a", 4);
  const fs::path file = directory_ / "state";
  ASSERT_TRUE(write_run_state(file, run->state().value()).has_value());
  const std::string whole = content(file);
  const auto refused = [&](const std::string& bytes) {
    EXPECT_TRUE(write_file(file, bytes).has_value());
    const auto read = read_run_state(file, run->file().mission);
    EXPECT_FALSE(read.has_value());
    if (!read) {
      EXPECT_NE(read.error().message.find(file.string()), std::string::npos);
    }
  };
  refused("");
  refused("{\"canopeer_record\":1}\n");
  refused("CANOPEER-STATE 9\n" + whole.substr(17));
  for (std::size_t i = 0; i < 40; ++i) {
    std::string damaged = whole;
    damaged[i * (whole.size() - 1) / 39] ^= 0x10;
    refused(damaged);
    refused(whole.substr(0, i * whole.size() / 40));
  }
}

}  // namespace
}  // namespace canopeer
