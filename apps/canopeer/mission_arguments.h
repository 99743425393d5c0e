#pragma once

#include "canopeer/run/stage.h"
#include "commands.h"

namespace CLI {
class App;
}

namespace canopeer::app {

/// The options of `mission` on a command line.
void add_mission(CLI::App& command, MissionArguments& mission);

/// What the mission's arguments and `extra` settings on top ask for; ends the command when an
/// argument is wrong.
[[nodiscard]] StageRequest stage_request(const MissionArguments& arguments,
                                         const Overrides& extra = {});

/// The mission with these settings; ends the command when something is wrong.
[[nodiscard]] MissionFile load(const MissionArguments& arguments, const Overrides& extra = {});

}  // namespace canopeer::app
