#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "canopeer/config/protocols.h"
#include "mission_arguments.h"
#include "options.h"

namespace canopeer::app {
namespace {

std::string comma_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

std::string protocol_list() {
  std::vector<std::string> names;
  for (const Protocol& protocol : protocols()) names.push_back(protocol.name);
  return comma_list(names);
}

void add_run(CLI::App& app, RunArguments& arguments, const RunRegistries& registries) {
  CLI::App* command = app.add_subcommand("run", "Run a mission and write the results");
  add_mission(*command, arguments.mission);
  command->add_option("--planner", arguments.planner,
                      "Planner: " + comma_list(registries.planners.names()));
  command->add_option("--protocol", arguments.protocol,
                      "Rules by name, in place of the mission's: " + protocol_list());
  command->add_option("--yardstick", arguments.yardstick,
                      "Give results as shares of this too (JSON, as `bound` writes it)");
  command->add_option("--site", arguments.site,
                      "What stands behind the ports: " + comma_list(registries.sites.names()));
  command->add_option("--segments", arguments.segments, "Only the first K segments");
  command->add_option("--time-per-segment", arguments.time_per_segment_s, "Seconds per segment");
  command->add_option("--threads", arguments.threads, "Threads at most (0: all cores)")
      ->check(CLI::Range(0, 1024));
  command->add_option("--compute-table", arguments.compute_table,
                      "What computing costs: default, reference, free, this-machine, or a file");
  command->add_flag("--realtime", arguments.realtime,
                    "On the wall clock, with worker threads, in place of simulated time");
  command->add_flag("--view", arguments.view.view,
                    "Serve a page that shows the run; its address is printed");
  command->add_option("--view-port", arguments.view.port, "Port of the page (0: any)");
  command->add_option(
      "--view-bind", arguments.view.address,
      "Address of the page; 0.0.0.0: other machines with the printed link may look");
  command->add_flag("!--no-replay", arguments.view.replay, "Leave out what `canopeer view` needs");
  command->add_flag("--dry-run", arguments.dry_run,
                    "Site ros2: plan and tell, and never move (ros2.dry_run)");
  command->add_flag("--confirm", arguments.confirm,
                    "Site ros2: ask before every motion (ros2.confirm)");
  command->add_option("--out", arguments.out, "Directory for the results");
  command->add_flag("--quiet", arguments.quiet, "Print errors only");
  command->add_flag("--profile", arguments.profile, "Print where the wall time went");
  command->callback([&arguments] { run(arguments); });
}

void add_view(CLI::App& app, ViewArguments& arguments) {
  CLI::App* command = app.add_subcommand("view", "Show a run again in a browser, a killed one too");
  command->add_option("run", arguments.run, "Directory of the run")->required();
  command->add_option("--view-port", arguments.port, "Port of the page (0: any)");
  command->add_option(
      "--view-bind", arguments.address,
      "Address of the page; 0.0.0.0: other machines with the printed link may look");
  command->add_flag("--quiet", arguments.quiet, "Print the address only");
  command->callback([&arguments] { view(arguments); });
}

void add_report(CLI::App& app, std::string& directory) {
  CLI::App* command = app.add_subcommand("report", "Make report.html of a finished run anew");
  command->add_option("dir", directory, "The run's directory")->required();
  command->callback([&directory] { report(directory); });
}

void add_calibrate(CLI::App& app, CalibrateArguments& a) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "Measure what computing costs on this machine: compute table this-machine");
  command->add_option("mission", a.mission.path, "Mission to measure on (default: smoke)");
  command->add_option("--out", a.out, "File to write (default: where runs find it by name)");
  command->add_flag("--quiet", a.quiet, "Print errors only");
  command->callback([&a] { calibrate(a); });
}

void add_doctor(CLI::App& app, DoctorArguments& a) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Say what this machine and this program have, and try the smoke mission");
  command->add_flag("--quick", a.quick, "No self-test");
  command->callback([&a] { doctor(a); });
}

}  // namespace canopeer::app
