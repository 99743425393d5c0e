#pragma once

#include <optional>

#include "canopeer/config/ros2_settings.h"
#include "canopeer/config/yaml_reader.h"

namespace canopeer {

/// The file that a mission's key `ros2` names, relative to the mission; nothing: the settings are a
/// mapping in the mission itself, or there are none. Its keys are called "ros2.KEY" in settings.
/// The error: it cannot be read.
[[nodiscard]] Expected<std::optional<YamlMap>> open_ros2_file(YamlMap& mission);

/// The settings `ros2` of a mission, in `file` where it names one. Nothing: it says none. What is
/// wrong is noted in the map it stands in.
[[nodiscard]] std::optional<Ros2Settings> read_ros2(YamlMap& mission, std::optional<YamlMap>& file);

}  // namespace canopeer
