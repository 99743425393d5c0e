#include "stop_signal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

namespace canopeer::app {
namespace {

// Each in a process of its own: what signals do is the process's.

TEST(StopSignal, ASecondOneEndsTheProgram) {
  const auto twice = [] {
    const auto& stop = catch_stop_signals();
    std::raise(SIGINT);
    if (!stop) _exit(1);
    std::raise(SIGINT);
    _exit(2);
  };
  EXPECT_EXIT(twice(), testing::KilledBySignal(SIGINT), "");
}

TEST(StopSignal, ASecondOneIsCaughtWhereThatIsWanted) {
  const auto three_times = [] {
    const auto& stop = catch_stop_signals();
    const auto& second = catch_second_stop();
    std::raise(SIGINT);
    if (!stop || second) _exit(1);
    std::raise(SIGINT);
    if (!second) _exit(2);
    std::raise(SIGINT);
    _exit(3);
  };
  EXPECT_EXIT(three_times(), testing::KilledBySignal(SIGINT), "");
}

TEST(StopSignal, AClosedTerminalStopsUnlessThatIsIgnored) {
  const auto hang_up = [](bool ignored) {
    if (ignored) std::signal(SIGHUP, SIG_IGN);
    const auto& stop = catch_stop_signals();
    std::raise(SIGHUP);
    std::raise(SIGPIPE);
    _exit(stop ? 10 : 11);
  };
  EXPECT_EXIT(hang_up(false), testing::ExitedWithCode(10), "");
  EXPECT_EXIT(hang_up(true), testing::ExitedWithCode(11), "");
}

}  // namespace
}  // namespace canopeer::app
