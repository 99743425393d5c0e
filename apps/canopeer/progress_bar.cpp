#include "progress_bar.h"

#include <unistd.h>

#include <cstdio>

namespace canopeer::app {

ProgressBar::ProgressBar(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()) {}

void ProgressBar::show(double fraction, const std::string& text, int stage) {
  if (quiet_) return;
  if (!terminal_ && stage_ >= 0 && stage != stage_) std::fprintf(stderr, "%s\n", text_.c_str());
  fraction_ = fraction;
  stage_ = stage;
  text_ = text;
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - drawn_at_ < std::chrono::milliseconds(100)) return;
  drawn_at_ = now;
  draw();
}

void ProgressBar::draw() {
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  constexpr int kWidth = 30;
  const int done = static_cast<int>(fraction_ * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(done), '#') +
                          std::string(static_cast<std::size_t>(kWidth - done), '.');
  const double eta = fraction_ > 0.0 ? elapsed / fraction_ - elapsed : 0.0;
  std::fprintf(stderr, "\r[%s] %s  ETA %3.0f s ", bar.c_str(), text_.c_str(), eta);
  drawn_ = true;
}

void ProgressBar::finish() {
  if (quiet_ || stage_ < 0) return;
  if (terminal_) {
    draw();
    std::fprintf(stderr, "\n");
  } else {
    std::fprintf(stderr, "%s\n", text_.c_str());
  }
}

}  // namespace canopeer::app
