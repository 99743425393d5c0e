#include <cstdio>
#include <ctime>
#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/cost_table_file.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/sim/calibration.h"
#include "commands.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "world_builder.h"

namespace canopeer::app {

/// Measures this machine's compute table and writes it where runs find it by the name
/// `this-machine`.
void calibrate(const CalibrateArguments& arguments) {
  const std::filesystem::path data = CANOPEER_DATA_DIR;
  MissionArguments mission = arguments.mission;
  if (mission.path.empty()) mission.path = (data / "missions" / "smoke.yaml").string();
  const MissionFile file = load(mission);
  const RobotModel robot = value_or_stop(load_robot(file.robot, file.T_frame_camera), kBadInput);
  const ArmIk ik = value_or_stop(ArmIk::make(robot), kBadInput);
  value_or_stop(make_detector(file.mission.detector), kBadInput);
  const ImportedScene world = build_world_or_stop(file.world, file.mission.seed, arguments.quiet);
  const CostTable costs = measure_costs(
      robot, ik, world.scene, file.mission, file.simulation, [&](std::string_view what) {
        if (!arguments.quiet) {
          std::printf("measuring %.*s\n", static_cast<int>(what.size()), what.data());
          std::fflush(stdout);
        }
      });
  const std::time_t now = std::time(nullptr);
  char day[16];
  std::strftime(day, sizeof day, "%Y-%m-%d", std::gmtime(&now));
  const std::string text = cost_table_text(
      costs, std::string("Measured by canopeer calibrate on ") + day + ", canopeer " +
                 CANOPEER_VERSION + "; CPU seconds of one core, the best of three.");
  const std::filesystem::path out = arguments.out.empty()
                                        ? data / "compute_tables" / "this-machine.yaml"
                                        : std::filesystem::path(arguments.out);
  value_or_stop(write_file(out, text), kFailed);
  if (!arguments.quiet) {
    std::printf("%swritten to %s; use it with --compute-table %s\n", text.c_str(), out.c_str(),
                arguments.out.empty() ? "this-machine" : arguments.out.c_str());
  }
}

}  // namespace canopeer::app
