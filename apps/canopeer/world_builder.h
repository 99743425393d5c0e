#pragma once

#include "canopeer/import/world_source.h"

namespace canopeer::app {

/// Makes the world and says on standard error how far a long import is, how it ended, and what is
/// missing; ends the command when it cannot be made.
[[nodiscard]] ImportedScene build_world_or_stop(const WorldSource& source, std::uint64_t seed,
                                                bool quiet);

}  // namespace canopeer::app
