#include <CLI/CLI.hpp>
#include <cstdio>

#include "commands.h"
#include "exit_status.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Plans where a robot's camera looks next, so that every fruit behind the leaves is found."};
  app.require_subcommand(1);
  canopeer::app::add_run_command(app);
  canopeer::app::add_report_command(app);
  canopeer::app::add_scene_command(app);
  app.add_subcommand("version", "Print the version")->callback([] {
    std::printf("canopeer %s\n", CANOPEER_VERSION);
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& end) {
    return end.get_exit_code();
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? canopeer::app::kDone : canopeer::app::kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "canopeer: internal error: %s\n", error.what());
    return canopeer::app::kFailed;
  }
  return canopeer::app::kDone;
}
