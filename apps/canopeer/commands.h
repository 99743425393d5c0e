#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/import/world_import.h"

namespace canopeer::app {

/// What several commands take to name a mission and change its settings.
struct MissionArguments {
  std::string path;
  std::vector<std::string> settings;  ///< "dotted.key=value"
  std::optional<std::uint64_t> seed;
};

struct RunArguments {
  MissionArguments mission;
  std::string planner;
  std::optional<int> segments;
  std::optional<double> time_per_segment_s;
  std::string compute_table;
  int threads = 0;  ///< 0: all cores
  std::string out;
  bool quiet = false;
  bool profile = false;
};

struct SceneArguments {
  MissionArguments mission;
  std::string out;
};

struct ImportArguments {
  std::string world;
  std::vector<std::string> model_paths;
  NamePatternOptions patterns;
  double min_fruit_cm3 = FruitComponentOptions().min_hull_cm3;
  bool ignore_up_axis = false;
  std::string out;
};

// The commands. Each ends by returning, or by throwing Stop.
void run(const RunArguments& arguments);
void report(const std::string& directory);
void scene_render(const SceneArguments& arguments);
void scene_inspect(const SceneArguments& arguments);
void scene_import(const ImportArguments& arguments);

}  // namespace canopeer::app
