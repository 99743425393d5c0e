#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/config/yaml_reader.h"
#include "canopeer/detect/detector_registry.h"

namespace canopeer {

/// Reads the section `detector` of a mission; paths start at `directory`, and `kinds` are the
/// detectors there are. What is wrong is noted in the map.
void read_detector(YamlMap detector, const std::filesystem::path& directory,
                   const std::vector<std::string>& kinds, DetectorOptions& o);

}  // namespace canopeer
