#pragma once

#include <filesystem>

#include "canopeer/config/yaml_reader.h"
#include "canopeer/detect/detector_registry.h"

namespace canopeer {

/// Reads the section `detector` of a mission; paths start at `directory`. What is wrong is noted in
/// the map.
void read_detector(YamlMap detector, const std::filesystem::path& directory, DetectorOptions& o);

}  // namespace canopeer
