#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "canopeer/mission/steering_desk.h"
#include "canopeer/run/run.h"
#include "canopeer/view/pace.h"
#include "canopeer/view/view_server.h"
#include "commands.h"

namespace canopeer::app {

/// The replay of a run that begins, and the page that shows it while it lasts.
class LiveView {
 public:
  /// Before Run::begin(). Ends the command when there can be no page (Stop). `stop` is set when
  /// somebody stops the run on the page; it outlives the view.
  LiveView(Run& run, SteeringTogether& steering, std::atomic<bool>& stop,
           const ViewArguments& arguments);
  /// As long as somebody looks on, and nobody pressed Ctrl-C.
  void stay(bool quiet) const;

 private:
  SteeringDesk desk_;
  Pace pace_;
  std::unique_ptr<ViewServer> server_;  // null: no page
};

/// The error when there is no page in this build.
void need_view_page();

}  // namespace canopeer::app
