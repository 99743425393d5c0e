#pragma once

namespace CLI {
class App;
}

namespace canopeer::app {

// Each adds its subcommands; the callbacks throw CLI::RuntimeError with the exit status when they
// do not end well.
void add_run_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_scene_command(CLI::App& app);

}  // namespace canopeer::app
