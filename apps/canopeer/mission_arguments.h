#pragma once

#include "canopeer/config/mission_file.h"
#include "commands.h"

namespace canopeer::app {

/// The mission with the settings of the command line and `extra` ones on top; ends the command when
/// something is wrong.
[[nodiscard]] MissionFile load(const MissionArguments& arguments, const Overrides& extra = {});

}  // namespace canopeer::app
