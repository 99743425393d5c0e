#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/import/sdf/sdf_element.h"

namespace canopeer {

/// Where a <population> puts its models, in its own frame. What Gazebo draws at random is drawn
/// here from a fixed seed and the population's name, so a world is the same each time. Error: file
/// and line, and what was expected.
[[nodiscard]] Expected<std::vector<Vec3>> population_places(const SdfElement& population);

}  // namespace canopeer
