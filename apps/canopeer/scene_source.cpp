#include "scene_source.h"

#include "canopeer/config/world_section.h"
#include "exit_status.h"
#include "fuel_caches.h"
#include "mission_arguments.h"

namespace canopeer::app {

SceneSource load_scene_source(const MissionArguments& arguments) {
  SceneSource source;
  if (is_scene_file(arguments.path)) {
    if (!arguments.settings.empty()) {
      stop_with(kBadInput, {"--set goes with missions; change the scene file " + arguments.path});
    }
    const SceneFile file = value_or_stop(load_scene_file(arguments.path), kBadInput);
    source.world = file.world;
    source.world.import.fuel_caches = fuel_caches();
    source.seed = arguments.seed.value_or(file.seed);
    return source;
  }
  source.mission = load(arguments);
  source.world = source.mission->world;
  source.world.import.fuel_caches = fuel_caches();
  source.seed = source.mission->mission.seed;
  return source;
}

}  // namespace canopeer::app
