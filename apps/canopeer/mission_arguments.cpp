#include "mission_arguments.h"

#include <CLI/CLI.hpp>

#include "exit_status.h"
#include "fuel_caches.h"
#include "robot_source.h"
#ifdef CANOPEER_ROS2
#include "ros2_words.h"
#endif
#include "shipped_data.h"

namespace canopeer::app {

void add_mission(CLI::App& command, MissionArguments& mission) {
  command
      .add_option("mission", mission.path,
                  "Mission file (YAML), or the name of a shipped one, e.g. scenario_1")
      ->required();
  command.add_option("--seed", mission.seed, "Seed of everything random");
  command
      .add_option("--set", mission.settings, "Override a setting, dotted.key=value (repeatable)")
      ->expected(1)
      ->take_all();
}

StageRequest stage_request(const MissionArguments& arguments, const Overrides& extra) {
  StageRequest request;
  request.mission = mission_file_of(arguments.path);
  request.overrides = arguments.ros2;
  for (const auto& setting : arguments.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      stop_with(kBadInput, {"--set " + setting + ": expected key=value"});
    }
    request.overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  if (arguments.seed) request.overrides.emplace_back("seed", std::to_string(*arguments.seed));
  request.overrides.insert(request.overrides.end(), extra.begin(), extra.end());
  request.table_dirs = {request.mission.parent_path() / "../compute_tables"};
  if (!own_data().empty()) request.table_dirs.push_back(own_data() / "compute_tables");
  request.table_dirs.push_back(shipped_data() / "compute_tables");
  request.fuel_caches = fuel_caches();
  request.package_path = ros_package_path();
  return request;
}

MissionFile load(const MissionArguments& arguments, const Overrides& extra) {
  const StageRequest request = stage_request(arguments, extra);
  MissionFile file = value_or_stop(
      load_mission(request.mission, request.overrides, request.table_dirs, *arguments.registries),
      kBadInput);
#ifdef CANOPEER_ROS2
  take_ros_domain(file);
#endif
  return file;
}

}  // namespace canopeer::app
