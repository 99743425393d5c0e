#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/cost_table_file.h"
#include "canopeer/sim/calibration.h"
#include "commands.h"
#include "exit_status.h"
#include "import_line.h"
#include "mission_arguments.h"
#include "shipped_data.h"

namespace canopeer::app {
namespace {

// Measuring takes a while: a folder that cannot be had is said before.
std::filesystem::path file_to_write(std::filesystem::path file) {
  if (file.empty()) {
    if (own_data().empty()) stop_with(kBadInput, {"HOME is not set; say --out FILE"});
    file = own_data() / "compute_tables" / "this-machine.yaml";
  }
  const std::filesystem::path folder = file.parent_path();
  std::error_code code;
  if (!folder.empty()) std::filesystem::create_directories(folder, code);
  if (code) stop_with(kFailed, {folder.string() + ": cannot be made: " + code.message()});
  return file;
}

}  // namespace

/// Measures this machine's compute table and writes it where runs find it by the name
/// `this-machine`.
void calibrate(const CalibrateArguments& arguments) {
  const std::filesystem::path out = file_to_write(arguments.out);
  MissionArguments mission = arguments.mission;
  if (mission.path.empty()) mission.path = "smoke";
  ImportLine line(arguments.quiet);
  StageRequest request = stage_request(mission);
  request.callbacks = callbacks_for_people(line, arguments.quiet);
  const auto stage = value_or_stop(Stage::make(request, *mission.registries), kBadInput);
  const MissionFile& file = stage->file();
  const RobotKit robot = stage->robot();
  const DetectorRegistry& detectors = mission.registries->detectors;
  static_cast<void>(value_or_stop(detectors.make(file.mission.detector), kBadInput));
  const CostTable costs =
      measure_costs(robot.model, robot.ik, *stage->site().truth(), file.mission, detectors,
                    file.simulation, [&](std::string_view what) {
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
  value_or_stop(write_file(out, text), kFailed);
  if (!arguments.quiet) {
    std::printf("%swritten to %s; use it with --compute-table %s\n", text.c_str(), out.c_str(),
                arguments.out.empty() ? "this-machine" : arguments.out.c_str());
  }
}

}  // namespace canopeer::app
