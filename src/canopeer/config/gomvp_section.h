#pragma once

#include "canopeer/config/yaml_reader.h"
#include "canopeer/planner/registry.h"

namespace canopeer {

/// The section `gomvp` of a mission file.
void read_gomvp(YamlMap gomvp, GomvpOptions& o);

}  // namespace canopeer
