#include "canopeer/program.h"

#include <fcntl.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "completion.h"
#include "exit_status.h"
#include "manual.h"
#include "options.h"
#ifdef CANOPEER_ROS2
#include "canopeer/ros2/ros2_site.h"
#include "ros2_commands.h"
#include "ros2_words.h"
#endif
#include "shipped_data.h"

namespace canopeer::app {
namespace {

void add_manual(CLI::App& app, ManualArguments& a) {
  CLI::App* command = app.add_subcommand(
      "manual", "Print the manual page of the program or of a command; read it with man -l -");
  command->add_option("command", a.command, "The command");
  command->add_option("--all", a.folder, "Write all pages into this folder, as man1/NAME.1");
  command->callback([&app, &a] { manual(app, a); });
}

/// What a shell may offer for the words of an unfinished command line.
void complete(const CLI::App& app, const RunRegistries& registries,
              const std::vector<std::string>& words) {
  CompletionNames names;
  names.missions = shipped_missions();
  names.planners = registries.planners.names();
  names.sites = registries.sites.names();
  names.compute_tables = {"default", "reference", "free", "this-machine"};
  for (const std::string& line : completions(app, names, words)) std::printf("%s\n", line.c_str());
}

/// A command that is left out of this build says so.
[[maybe_unused]] void add_left_out(CLI::App& app, const std::string& name) {
  CLI::App* command = app.add_subcommand(name, "Not in this build: " + std::string(kWholeBuild));
  command->allow_extras();
  command->callback(
      [name] { stop_with(kBadInput, {name + " is not in this build: " + kWholeBuild}); });
}

/// A program started with one of them closed would take its first file for it. Whole lines go out
/// at once, so that they stand before what standard error says later.
void open_standard_streams() {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  for (int stream = 0; stream <= 2; ++stream) {
    if (fcntl(stream, F_GETFD) == -1) static_cast<void>(open("/dev/null", O_RDWR));
  }
}

/// Every command may name what is registered.
int parse_and_run(int argc, char** argv, const RunRegistries& registries) {
  CLI::App app{
      "Plans where a robot's camera looks next, so that every fruit behind the leaves is found."};
  app.require_subcommand(1);
  RunArguments run_arguments;
  std::string report_directory;
  ViewArguments view_arguments;
  SceneArguments scene_arguments;
  ImportArguments import_arguments;
  run_arguments.mission.registries = &registries;
  add_run(app, run_arguments, registries);
  CalibrateArguments calibrate_arguments;
  calibrate_arguments.mission.registries = &registries;
  scene_arguments.mission.registries = &registries;
#ifdef CANOPEER_CAMPAIGNS
  BenchArguments bench_arguments;
  SuiteArguments suite_arguments;
  VerifyArguments verify_arguments;
  BoundArguments bound_arguments;
  bench_arguments.registries = &registries;
  suite_arguments.registries = &registries;
  bound_arguments.mission.registries = &registries;
  add_bench(app, bench_arguments, suite_arguments, verify_arguments);
  add_bound(app, bound_arguments);
#else
  add_left_out(app, "bench");
  add_left_out(app, "bound");
#endif
  add_calibrate(app, calibrate_arguments);
  add_report(app, report_directory);
  add_view(app, view_arguments);
  add_scene(app, scene_arguments, import_arguments);
  FruitFitArguments fruit_arguments;
  add_fruit(app, fruit_arguments);
  MapArguments map_arguments;
  add_map(app, map_arguments);
  RobotCheckArguments robot_arguments;
  add_robot(app, robot_arguments);
#ifdef CANOPEER_ROS2
  Ros2Arguments ros2_arguments;
  const ros::RosArguments ros_arguments = take_ros_arguments(argc, argv);
  ros2_arguments.robot.node = ros_arguments.node.value_or(ros2_arguments.robot.node);
  ros2_arguments.robot.mission.ros2 = ros2_settings(ros_arguments, ros2_arguments.robot.node);
  run_arguments.mission.ros2 = ros2_settings(ros_arguments, Ros2Settings().node);
  ros2_arguments.check.mission.ros2 = run_arguments.mission.ros2;
  add_ros2(app, ros2_arguments, registries);
  std::vector<std::string> words(ros_arguments.rest.rbegin(), ros_arguments.rest.rend() - 1);
#else
  add_left_out(app, "ros2");
  std::vector<std::string> words(std::make_reverse_iterator(argv + argc),
                                 std::make_reverse_iterator(argv + 1));
#endif
  DoctorArguments doctor_arguments;
  doctor_arguments.registries = &registries;
  add_doctor(app, doctor_arguments);
  app.set_version_flag("--version", std::string("canopeer ") + CANOPEER_VERSION);
  app.footer(std::string("Exit status: ") + kExitStatusText);
  ManualArguments manual_arguments;
  add_manual(app, manual_arguments);
  app.add_subcommand("version", "Print the version")->callback([] {
    std::printf("canopeer %s\n", CANOPEER_VERSION);
  });
  if (argc > 1 && std::string(argv[1]) == "complete") {
    complete(app, registries, {argv + 2, argv + argc});
    return kDone;
  }
  try {
    app.name(argv[0]);
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    std::fflush(stdout);
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  return kDone;
}

}  // namespace
}  // namespace canopeer::app

namespace canopeer {

int run_program(int argc, char** argv, const RunRegistries& with) {
  app::open_standard_streams();
  RunRegistries registries = with;
#ifdef CANOPEER_ROS2
  add_ros2_site(registries.sites);
#endif
  try {
    const int status = app::parse_and_run(argc, argv, registries);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    std::fprintf(stderr, "canopeer: cannot write to standard output\n");
    return status == app::kDone ? app::kFailed : status;
  } catch (const app::Stop& stop) {
    return stop.status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "canopeer: internal error: %s\n", error.what());
    return app::kFailed;
  }
}

}  // namespace canopeer
