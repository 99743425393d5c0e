#include <sys/sysinfo.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include "canopeer/base/simd_level.h"
#include "canopeer/run/run.h"
#include "canopeer/view/view_page.h"
#include "commands.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "shipped_data.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

constexpr double kGigabyte = 1e9;

void line(const char* what, const std::string& text) {
  std::printf("%-15s%s\n", what, text.c_str());
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string memory_text() {
  struct sysinfo info {};
  if (sysinfo(&info) != 0) return "unknown";
  const double unit = info.mem_unit;
  char text[120];
  std::snprintf(text, sizeof text, "%.1f GB, %.1f GB of it free; a mission needs about 0.5 GB",
                unit * static_cast<double>(info.totalram) / kGigabyte,
                unit * static_cast<double>(info.freeram + info.bufferram) / kGigabyte);
  return text;
}

std::string own_table_text() {
  const fs::path own = own_data() / "compute_tables" / "this-machine.yaml";
  std::error_code code;
  const auto written = fs::last_write_time(own, code);
  if (code) return "none of this machine; 'canopeer calibrate' measures one in a minute";
  const auto age = fs::file_time_type::clock::now() - written;
  const auto days = std::chrono::duration_cast<std::chrono::hours>(age).count() / 24;
  return "this-machine, " + std::to_string(days) + " days old";
}

/// The smoke mission, from its file to its report, in a folder of its own.
bool self_test(const RunRegistries& registries) {
  MissionArguments mission;
  mission.registries = &registries;
  mission.path = "smoke";
  const fs::path out = fs::temp_directory_path() / ("canopeer_doctor_" + std::to_string(getpid()));
  auto run = Run::compose(stage_request(mission), registries, out);
  const auto summary = run ? (*run)->execute() : Expected<Summary>(tl::unexpected(run.error()));
  std::error_code code;
  fs::remove_all(out, code);
  if (!summary) {
    line("self-test", "failed: " + summary.error().message);
    return false;
  }
  char text[160];
  std::snprintf(text, sizeof text, "the smoke mission: %d fruits in %d views, %.0f times real time",
                summary->detected.value_or(0), summary->views,
                summary->sim_time_s / summary->wall_time_s);
  line("self-test", text);
  if (summary->detected.value_or(0) > 0 && summary->collisions == 0) return true;
  line("", "failed: fruits and no collisions were expected");
  return false;
}

}  // namespace

void doctor(const DoctorArguments& arguments) {
  const RunRegistries& registries = *arguments.registries;
  line("canopeer", CANOPEER_VERSION);
  line("processor", std::to_string(std::thread::hardware_concurrency()) + " cores, kernels for " +
                        simd_level_name(best_simd_level()));
  line("memory", memory_text());
  line("live view", view_page().empty()
                        ? "not built in: that takes Node 18 (Debian: npm) and the npm registry"
                        : "built in");
  line("ROS 2", registries.sites.one_line("ros2").empty()
                    ? "not built in: " + std::string(kWholeBuild)
                    : "built in");
#ifdef CANOPEER_CAMPAIGNS
  line("bench, bound", "built in");
#else
  line("bench, bound", "not built in: " + std::string(kWholeBuild));
#endif
  line("files", shipped_data().string());
  line("missions", joined(shipped_missions()));
  line("compute table", own_table_text());
  line("planners", joined(registries.planners.names()));
  line("detectors", joined(registries.detectors.names()));
  line("sites", joined(registries.sites.names()));
  std::fflush(stdout);
  if (shipped_missions().empty()) {
    stop_with(
        kFailed,
        {shipped_data().string() +
         ": has no missions; CANOPEER_DATA may name the folder that holds missions/, robots/ and "
         "compute_tables/"});
  }
  if (!arguments.quick && !self_test(registries)) throw Stop{kFailed};
}

}  // namespace canopeer::app
