#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <utility>

#include "canopeer/view/view_page.h"
#include "canopeer/view/view_server.h"
#include "commands.h"
#include "exit_status.h"
#include "live_view.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

std::shared_ptr<ReplayLog> log_of(const std::filesystem::path& run) {
  if (!std::filesystem::is_directory(run)) {
    stop_with(kBadInput, {run.string() + ": no such directory; give that of a run (out/…)"});
  }
  if (!std::filesystem::exists(run / "replay")) {
    stop_with(kBadInput, {run.string() + ": has no replay: the run was made with --no-replay, in "
                                         "a campaign, or by an older canopeer"});
  }
  std::shared_ptr<ReplayLog> log = value_or_stop(ReplayLog::open(run / "replay"), kBadInput);
  if (log->pieces() == 0) {
    stop_with(kBadInput, {(run / "replay").string() + ": nothing in it is whole"});
  }
  if (log->lost_bytes() > 0) {
    std::fprintf(stderr,
                 "canopeer: notice: the end of the replay is damaged; shown is what is whole\n");
  }
  return log;
}

}  // namespace

void view(const ViewArguments& arguments) {
  need_view_page();
  ViewServerOptions options;
  options.address = arguments.address;
  options.port = arguments.port;
  options.token = new_view_token();
  options.page = view_page();
  options.report = std::filesystem::path(arguments.run) / "report.html";
  const auto& stop = catch_stop_signals();
  const auto server = value_or_stop(ViewServer::start(options, log_of(arguments.run)), kBadInput);
  std::printf("%s\n", server->link().c_str());
  std::fflush(stdout);
  if (!arguments.quiet) std::fprintf(stderr, "canopeer: Ctrl-C ends it\n");
  while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace canopeer::app
