#include <cstdio>
#include <filesystem>

#include "canopeer/report/report.h"
#include "commands.h"
#include "exit_status.h"

namespace canopeer::app {

void report(const std::string& directory) {
  value_or_stop(write_report(directory), kBadInput);
  std::printf("%s\n", (std::filesystem::path(directory) / "report.html").c_str());
}

}  // namespace canopeer::app
