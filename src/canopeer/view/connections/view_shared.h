#pragma once

#include <atomic>
#include <chrono>
#include <memory>

#include "canopeer/view/view_guard.h"
#include "canopeer/view/view_server.h"

namespace canopeer {

/// For a request, and for a frame to be taken.
constexpr std::chrono::seconds kViewPatience(20);

/// What all connections share. Lives in the server's thread but for the counters.
struct ViewShared {
  ViewServerOptions options;
  std::shared_ptr<ReplayLog> log;
  ViewControls controls;
  ViewGuard guard;
  double speed = 0.0;  ///< as said last
  std::atomic<int> readers{0};
  int connections = 0;
};

}  // namespace canopeer
