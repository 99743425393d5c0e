// Runs a mission and stops dead after some steps, or goes on from there.
//   run_in_parts MISSION OUT PLANNER STEPS STATE   begins, writes STATE after so many steps, exits
//   run_in_parts MISSION OUT PLANNER go-on STATE   goes on to the end

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "canopeer/run/run.h"

namespace {

using namespace canopeer;

constexpr std::string_view kOnTheWay = "_on_the_way";  // behind a planner's name: with frames

template <typename T>
T must(Expected<T> value) {
  if (!value) {
    std::fprintf(stderr, "%s\n", value.error().message.c_str());
    std::_Exit(1);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*value);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  StageRequest request;
  request.mission = argv[1];
  std::string planner = argv[3];
  const std::size_t on_the_way = planner.find(kOnTheWay);
  planner = planner.substr(0, on_the_way);
  request.overrides = {{"planner", planner},
                       {"time_per_segment_s", "4"},
                       {"sides", "[1, 2]"},
                       {"simulation.arrival_error_rad", "0.003"},
                       {"noise", "d435"}};
  if (on_the_way != std::string::npos) {
    request.overrides.emplace_back("frames.on_the_way_hz", "10");
    request.overrides.emplace_back("camera.motion", "d405");
  }
  request.table_dirs = {CANOPEER_TABLES};
  const RunRegistries registries = RunRegistries::built_in();
  const auto run = must(Run::compose(request, registries, argv[2]));
  const std::string steps = argv[4];
  if (steps == "go-on") {
    must(run->resume(must(read_run_state(argv[5], run->file().mission))));
    while (run->step()) {
    }
    must(run->finish());
    must(Expected<void>(run->outcome()));
    return 0;
  }
  must(run->begin());
  for (int i = 0; i < std::atoi(steps.c_str()); ++i) {
    if (!run->step()) std::_Exit(3);  // the run is over already
  }
  must(write_run_state(argv[5], must(run->state())));
  // The record goes on a little after the state was written, as it does in a run that is killed.
  static_cast<void>(run->step());
  std::_Exit(0);
}
