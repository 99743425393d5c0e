#include "world_builder.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "exit_status.h"

namespace canopeer::app {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// A line that is redrawn on a terminal; elsewhere only the last word is said.
class ImportLine {
 public:
  explicit ImportLine(bool quiet) : live_(!quiet && isatty(STDERR_FILENO) == 1) {}

  void show(const ImportProgress& progress) {
    const auto now = SteadyClock::now();
    if (!live_ || (drawn_ && now - drawn_at_ < std::chrono::milliseconds(100))) return;
    std::fprintf(stderr, "\rimport: %zu of %zu shapes, %zu triangles ", progress.done,
                 progress.total, progress.triangles);
    drawn_ = true;
    drawn_at_ = now;
  }

  /// Leaves the line.
  void clear() const {
    if (drawn_) std::fprintf(stderr, "\r\033[K");
  }

 private:
  bool live_;
  bool drawn_ = false;
  SteadyClock::time_point drawn_at_;
};

}  // namespace

ImportedScene build_world_or_stop(const WorldSource& source, std::uint64_t seed, bool quiet) {
  const auto begin = SteadyClock::now();
  ImportLine line(quiet);
  auto built = build_world(source, seed, [&](const ImportProgress& p) { line.show(p); });
  line.clear();
  if (!built) stop_with(kBadInput, built.error());
  if (source.imported() && !quiet) {
    std::fprintf(stderr, "imported %s: %zu triangles, %zu fruits (%d count) in %.1f s\n",
                 built->scene.name.c_str(), built->scene.triangle_count(),
                 built->scene.fruits.size(), built->scene.counted_fruits(),
                 std::chrono::duration<double>(SteadyClock::now() - begin).count());
  }
  for (const std::string& notice : built->notices) {
    std::fprintf(stderr, "canopeer: notice: %s\n", notice.c_str());
  }
  return std::move(*built);
}

}  // namespace canopeer::app
