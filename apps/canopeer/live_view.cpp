#include "live_view.h"

#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

#include "canopeer/replay/replay_watcher.h"
#include "canopeer/view/view_page.h"
#include "exit_status.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

RunStory story_of(Run& run) {
  const MissionFile& file = run.file();
  RunStory story;
  story.mission = file.mission.name;
  story.planner = file.mission.planner;
  story.seed = file.mission.seed;
  story.canopeer_version = CANOPEER_VERSION;
  story.simulated = run.stage().site().ports().clock->simulated();
  story.segment_time_s = file.mission.segment_time_s;
  story.resolution_m = file.mission.map.resolution_m;
  story.segments = file.mission.segments;
  story.camera = file.simulation.camera;
  return story;
}

std::shared_ptr<ReplayLog> new_unnamed_log() {
  return value_or_stop(ReplayLog::create_unnamed(), kFailed);
}

std::shared_ptr<ReplayLog> new_log(const Run& run, bool keep) {
  if (!keep) return new_unnamed_log();
  return value_or_stop(ReplayLog::create(run.out() / "replay"), kFailed);
}

/// Before the replay of an earlier run there is overwritten.
void need_free_port(const ViewArguments& arguments) {
  ViewServerOptions options;
  options.address = arguments.address;
  options.port = arguments.port;
  value_or_stop(ViewServer::start(options, new_unnamed_log()), kBadInput);
}

}  // namespace

void need_view_page() {
  if (!view_page().empty()) return;
  stop_with(kBadInput,
            {"this program was built without its page: without Node 18 (Debian: npm), or where npm "
             "reached no registry; build it again with both"});
}

LiveView::LiveView(Run& run, SteeringTogether& steering, std::atomic<bool>& stop,
                   const ViewArguments& arguments)
    : pace_([this, &signal = catch_stop_signals()] { return signal || desk_.unread(); }) {
  if (arguments.view) {
    need_view_page();
    need_free_port(arguments);
  }
  if (!arguments.view && !arguments.replay) return;
  const std::shared_ptr<ReplayLog> log = new_log(run, arguments.replay);
  RunStory story = story_of(run);
  const bool simulated = story.simulated;
  auto frames = std::make_unique<RunFrames>(std::move(story), run.stage().robot().model,
                                            run.stage().site().truth());
  run.watch(std::make_shared<ReplayWatcher>(std::move(frames), log),
            {.name = "the replay", .wait_in_simulated_time = true});
  if (!arguments.view) return;
  if (simulated) steering.add(pace_);  // before the desk: what is said ends its waiting
  steering.add(desk_);
  ViewServerOptions options;
  options.address = arguments.address;
  options.port = arguments.port;
  options.token = new_view_token();
  options.page = view_page();
  options.report = run.out() / "report.html";
  options.live = true;
  ViewControls controls;
  controls.steer = [this, &stop](SteeringWord::Kind word) {
    desk_.say({word, "page", ""});
    if (word == SteeringWord::Kind::stop) stop = true;  // what moves now stops too
  };
  if (simulated) controls.speed = [this](double factor) { pace_.set(factor); };
  server_ = value_or_stop(ViewServer::start(options, log, std::move(controls)), kBadInput);
  std::fprintf(stderr, "canopeer: watch at %s\n", server_->link().c_str());
}

void LiveView::stay(bool quiet) const {
  if (!server_ || server_->readers() == 0) return;
  if (!quiet) {
    std::fprintf(stderr, "canopeer: the page stays until it is closed, or Ctrl-C is pressed\n");
  }
  const auto& stop = catch_stop_signals();
  while (server_->readers() > 0 && !stop)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace canopeer::app
