#pragma once

#include <cstdint>

#include "canopeer/scene/scene.h"

namespace canopeer {

/// A number over everything that is seen or scored in a scene: shapes, places, colours, classes and
/// fruits (FNV-1a over their bits). Equal scenes have equal numbers on every machine.
std::uint64_t scene_hash(const Scene& scene);

}  // namespace canopeer
