#include "stop_signal.h"

#include <csignal>

namespace canopeer::app {
namespace {

// A signal handler reaches nothing else.
std::atomic<bool> g_stop{false};
std::atomic<bool> g_second_stop{false};
std::atomic<bool> g_catch_second{false};

void on_signal(int signal) {
  if (g_stop.exchange(true)) g_second_stop = true;
  if (g_catch_second && !g_second_stop) return;
  std::signal(signal, SIG_DFL);
}

/// Whoever started the program with `nohup` wants it to outlive its terminal.
void catch_unless_ignored(int signal) {
  if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace

const std::atomic<bool>& catch_stop_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  catch_unless_ignored(SIGHUP);
  std::signal(SIGPIPE, SIG_IGN);
  return g_stop;
}

const std::atomic<bool>& catch_second_stop() {
  catch_stop_signals();
  g_catch_second = true;
  return g_second_stop;
}

}  // namespace canopeer::app
