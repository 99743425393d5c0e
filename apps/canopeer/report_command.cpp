#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "canopeer/report/report.h"
#include "commands.h"
#include "exit_status.h"

namespace canopeer::app {

void add_report_command(CLI::App& app) {
  auto directory = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "Make report.html of a finished run anew");
  command->add_option("dir", *directory, "The run's directory")->required();
  command->callback([directory] {
    value_or_stop(write_report(*directory), kBadInput);
    std::printf("%s\n", (std::filesystem::path(*directory) / "report.html").c_str());
  });
}

}  // namespace canopeer::app
