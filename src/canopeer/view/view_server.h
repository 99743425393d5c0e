#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/mission/steering.h"
#include "canopeer/replay/replay_log.h"

namespace canopeer {

/// Where a page is served, and what is served beside it.
struct ViewServerOptions {
  std::string address = "127.0.0.1";  ///< an address of this machine; "0.0.0.0": all of them
  std::uint16_t port = 8765;          ///< 0: any that is free
  std::string token;                  ///< who has it may steer; beyond this machine, also look
  std::string_view page;              ///< the page as HTML; outlives the server
  std::filesystem::path report;       ///< of a run that has ended; may not be there yet
  bool live = false;                  ///< more is to come
};

/// What readers with the token may do; empty: nobody may. Called in the server's thread.
struct ViewControls {
  std::function<void(SteeringWord::Kind)> steer;
  std::function<void(double)> speed;  ///< mission seconds a second; 0: as fast as it goes
};

/// Serves a run to browsers: the page, and its frames over a WebSocket (docs/live-view.md). In a
/// thread of its own; every reader reads the log at its own pace, so a slow one costs nobody else
/// anything. Strangers are refused: names of other hosts, pages from elsewhere, wrong tokens, too
/// many readers, too much or too long input.
class ViewServer {
 public:
  /// The error: the address is not one of this machine's, or the port is taken.
  [[nodiscard]] static Expected<std::unique_ptr<ViewServer>> start(const ViewServerOptions& options,
                                                                   std::shared_ptr<ReplayLog> log,
                                                                   ViewControls controls = {});
  ~ViewServer();

  /// What to open in a browser, with the token.
  [[nodiscard]] std::string link() const;
  [[nodiscard]] std::uint16_t port() const;
  /// How many browsers look on now.
  [[nodiscard]] int readers() const;

 private:
  struct State;
  explicit ViewServer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Thirty-two hexadecimal digits by the system's source of randomness.
[[nodiscard]] std::string new_view_token();

}  // namespace canopeer
