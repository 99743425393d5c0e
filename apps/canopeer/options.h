#pragma once

#include <string>

#include "commands.h"

namespace CLI {
class App;
}

namespace canopeer::app {

// Each adds a command with its options, which leave what they say in the arguments.
void add_run(CLI::App& app, RunArguments& arguments, const RunRegistries& registries);
void add_view(CLI::App& app, ViewArguments& arguments);
void add_report(CLI::App& app, std::string& directory);
void add_calibrate(CLI::App& app, CalibrateArguments& arguments);
void add_doctor(CLI::App& app, DoctorArguments& arguments);
void add_bench(CLI::App& app, BenchArguments& arguments, SuiteArguments& suite,
               VerifyArguments& verify);
void add_bound(CLI::App& app, BoundArguments& arguments);
void add_scene(CLI::App& app, SceneArguments& arguments, ImportArguments& import_arguments);
void add_fruit(CLI::App& app, FruitFitArguments& arguments);
void add_map(CLI::App& app, MapArguments& arguments);
void add_robot(CLI::App& app, RobotCheckArguments& arguments);

/// The rules that a run may go by: "a, b, c".
[[nodiscard]] std::string protocol_list();

}  // namespace canopeer::app
