#include "progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace canopeer::app {
namespace {

std::string line(const MissionProgress& p) {
  char text[160];
  std::snprintf(text, sizeof text, "segment %d/%d  mission time %6.1f s  %4d views  %3d fruits",
                p.segment + 1, p.segments, p.time_s, p.views, p.fruits);
  return text;
}

}  // namespace

ProgressBar::ProgressBar(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()) {}

void ProgressBar::show(const MissionProgress& progress) {
  if (quiet_) return;
  if (!terminal_) {
    if (last_segment_ >= 0 && progress.segment != last_segment_) {
      std::fprintf(stderr, "%s\n", line(last_).c_str());
    }
    last_segment_ = progress.segment;
    last_ = progress;
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - drawn_at_ < std::chrono::milliseconds(100)) return;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  constexpr int kWidth = 30;
  const int done = static_cast<int>(progress.fraction * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(done), '#') +
                          std::string(static_cast<std::size_t>(kWidth - done), '.');
  const double eta = progress.fraction > 0.0 ? elapsed / progress.fraction - elapsed : 0.0;
  std::fprintf(stderr, "\r[%s] %s  ETA %3.0f s ", bar.c_str(), line(progress).c_str(), eta);
  drawn_ = true;
  drawn_at_ = now;
}

void ProgressBar::finish() {
  if (quiet_) return;
  if (terminal_ && drawn_) std::fprintf(stderr, "\n");
  if (!terminal_ && last_segment_ >= 0) std::fprintf(stderr, "%s\n", line(last_).c_str());
}

}  // namespace canopeer::app
