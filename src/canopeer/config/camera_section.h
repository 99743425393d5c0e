#pragma once

#include "canopeer/config/mission_file.h"
#include "canopeer/config/yaml_reader.h"

namespace canopeer {

/// Reads the `camera:` section of a mission: preset, intrinsics, lens, mounting, hand–eye error,
/// `motion:` (a preset's name) and `motion_model:` (its figures one by one). Complaints go to
/// `camera`.
void read_camera(YamlMap camera, MissionFile& mission);

/// Reads `noise:` (a preset's name), `noise_model:` (its figures one by one) and `label_noise:` at
/// the top of a mission. `noise: labels_70` is a camera without noise whose labels are right with
/// probability 0.7, the published protocol of surface recall and F1 (arXiv 2601.12122); `detector`
/// then goes by labels unless the mission says otherwise.
void read_noise(YamlMap& file, RgbdSensorOptions& sensor, DetectorOptions& detector);
/// Complains about `noise: labels_70` for a detector that looks at no labels.
void check_labels(YamlMap& file, const DetectorOptions& detector);

}  // namespace canopeer
