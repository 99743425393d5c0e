#pragma once

#include <filesystem>
#include <vector>

namespace canopeer::app {

/// Where programs of Gazebo keep the models they have fetched, as their own settings say:
/// GZ_FUEL_CACHE_PATH, IGN_FUEL_CACHE_PATH, then ~/.gz/fuel and ~/.ignition/fuel.
[[nodiscard]] std::vector<std::filesystem::path> fuel_caches();

}  // namespace canopeer::app
