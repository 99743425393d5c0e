#include "stop_signal.h"

#include <csignal>

namespace canopeer::app {
namespace {

std::atomic<bool> g_stop{false};  // a signal handler reaches nothing else

void on_signal(int signal) {
  g_stop = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

std::atomic<bool>& catch_stop_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return g_stop;
}

}  // namespace canopeer::app
