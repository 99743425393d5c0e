#pragma once

#include "canopeer/config/yaml_reader.h"
#include "canopeer/fruit/fruit_map_options.h"

namespace canopeer {

/// Reads the sections `fruit` and `rows` of a mission. What is wrong is noted in the map.
void read_fruit(YamlMap& file, FruitMapOptions& o);

}  // namespace canopeer
