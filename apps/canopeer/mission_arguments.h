#pragma once

#include "canopeer/run/stage.h"
#include "commands.h"

namespace canopeer::app {

/// What the mission's arguments and `extra` settings on top ask for; ends the command when an
/// argument is wrong.
[[nodiscard]] StageRequest stage_request(const MissionArguments& arguments,
                                         const Overrides& extra = {});

/// The mission with these settings; ends the command when something is wrong.
[[nodiscard]] MissionFile load(const MissionArguments& arguments, const Overrides& extra = {});

}  // namespace canopeer::app
