#pragma once

#include "canopeer/config/yaml_reader.h"
#include "canopeer/planner/registry.h"

namespace canopeer {

/// The keys `nbs` and `nbv` of a mission file.
void read_nbs(YamlMap nbs, NbsOptions& options);
void read_nbv(YamlMap nbv, NbvOptions& options);

}  // namespace canopeer
