#pragma once

#include "canopeer/config/mission_file.h"
#include "canopeer/config/yaml_reader.h"

namespace canopeer {

/// Reads the `camera:` section of a mission: preset, intrinsics, lens, mounting, hand–eye error,
/// `motion:` (a preset's name) and `motion_model:` (its figures one by one). Complaints go to
/// `camera`.
void read_camera(YamlMap camera, MissionFile& mission);

/// Reads `noise:` (a preset's name), `noise_model:` (its figures one by one) and `label_noise:` at
/// the top of a mission.
void read_noise(YamlMap& file, RgbdSensorOptions& sensor);

}  // namespace canopeer
