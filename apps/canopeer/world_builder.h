#pragma once

#include <optional>

#include "canopeer/detect/detector_registry.h"
#include "canopeer/import/world_source.h"

namespace canopeer::app {

/// Makes the world and says on standard error how far a long import is, how it ended, what is
/// missing, and when `detector` cannot see its fruits; ends the command when it cannot be made.
[[nodiscard]] ImportedScene build_world_or_stop(
    const WorldSource& source, std::uint64_t seed,
    const std::optional<DetectorOptions>& detector = std::nullopt);

}  // namespace canopeer::app
