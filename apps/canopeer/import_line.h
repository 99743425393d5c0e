#pragma once

#include <chrono>

#include "canopeer/run/site.h"

namespace canopeer::app {

/// Says on standard error how far a long import is: a line that is redrawn on a terminal, nothing
/// elsewhere.
class ImportLine {
 public:
  explicit ImportLine(bool quiet);
  ~ImportLine() { clear(); }
  ImportLine(const ImportLine&) = delete;
  ImportLine& operator=(const ImportLine&) = delete;

  void show(const ImportProgress& progress);
  /// Leaves the line.
  void clear();

 private:
  bool live_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point drawn_at_;
};

/// What a site says while it is made, to people: progress and news unless `quiet`, notices always.
/// `line` outlives the callbacks.
[[nodiscard]] SiteCallbacks callbacks_for_people(ImportLine& line, bool quiet);

}  // namespace canopeer::app
