#include "mission_arguments.h"

#include "exit_status.h"

namespace canopeer::app {

MissionFile load(const MissionArguments& arguments, const Overrides& extra) {
  Overrides overrides;
  for (const auto& setting : arguments.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      stop_with(kBadInput, {"--set " + setting + ": expected key=value"});
    }
    overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  if (arguments.seed) overrides.emplace_back("seed", std::to_string(*arguments.seed));
  overrides.insert(overrides.end(), extra.begin(), extra.end());
  const std::vector<std::filesystem::path> tables = {
      std::filesystem::path(arguments.path).parent_path() / "../compute_tables",
      std::filesystem::path(CANOPEER_DATA_DIR) / "compute_tables"};
  return value_or_stop(load_mission(arguments.path, overrides, tables), kBadInput);
}

}  // namespace canopeer::app
