#include "import_line.h"

#include <unistd.h>

#include <cstdio>

namespace canopeer::app {

using SteadyClock = std::chrono::steady_clock;

ImportLine::ImportLine(bool quiet) : live_(!quiet && isatty(STDERR_FILENO) == 1) {}

void ImportLine::show(const ImportProgress& progress) {
  const auto now = SteadyClock::now();
  if (!live_ || (drawn_ && now - drawn_at_ < std::chrono::milliseconds(100))) return;
  std::fprintf(stderr, "\rimport: %zu of %zu shapes, %zu triangles ", progress.done, progress.total,
               progress.triangles);
  drawn_ = true;
  drawn_at_ = now;
}

void ImportLine::clear() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

SiteCallbacks callbacks_for_people(ImportLine& line, bool quiet) {
  SiteCallbacks callbacks;
  callbacks.on_import = [&line](const ImportProgress& progress) { line.show(progress); };
  callbacks.on_news = [&line, quiet](const std::string& text) {
    line.clear();
    if (!quiet) std::fprintf(stderr, "%s\n", text.c_str());
  };
  callbacks.on_notice = [&line](const std::string& text) {
    line.clear();
    std::fprintf(stderr, "canopeer: notice: %s\n", text.c_str());
  };
  return callbacks;
}

}  // namespace canopeer::app
