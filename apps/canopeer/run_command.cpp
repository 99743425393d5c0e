#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "canopeer/config/robot_file.h"
#include "canopeer/mission/mission.h"
#include "canopeer/sim/simulation.h"
#include "commands.h"
#include "exit_status.h"
#include "mission_arguments.h"
#include "progress_bar.h"
#include "run_results.h"
#include "stop_signal.h"
#include "world_builder.h"

namespace canopeer::app {
namespace {

Overrides overrides_of(const RunArguments& arguments) {
  Overrides o;
  if (!arguments.planner.empty()) o.emplace_back("planner", arguments.planner);
  if (arguments.segments) o.emplace_back("max_segments", std::to_string(*arguments.segments));
  if (arguments.time_per_segment_s) {
    o.emplace_back("time_per_segment_s", std::to_string(*arguments.time_per_segment_s));
  }
  if (!arguments.compute_table.empty()) o.emplace_back("compute_table", arguments.compute_table);
  return o;
}

std::string line_of(const MissionProgress& p) {
  char text[160];
  std::snprintf(text, sizeof text, "segment %d/%d  mission time %6.1f s  %4d views  %3d fruits",
                p.segment + 1, p.segments, p.time_s, p.views, p.fruits);
  return text;
}

RunHeader header_of(const MissionFile& file) {
  RunHeader header;
  header.canopeer_version = CANOPEER_VERSION;
  header.mission = file.mission.name;
  header.planner = file.mission.planner;
  header.seed = file.mission.seed;
  header.compute_table = file.compute_table;
  header.segments = static_cast<int>(file.mission.segments.size());
  header.segment_time_s = file.mission.segment_time_s;
  header.settings_json = file.settings_json;
  return header;
}

void print_profile(const StageTimer& timer, double wall_s) {
  std::printf("\n%-18s %9s\n", "stage", "wall s");
  for (const auto& [stage, seconds] : timer.seconds()) {
    std::printf("%-18s %9.2f\n", stage.c_str(), seconds);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%-18s %9.2f\npeak memory        %9.0f MB\n", "all", wall_s,
              static_cast<double>(usage.ru_maxrss) / 1024.0);
}

/// One thread acts and searches, the others grow the graph.
void run_on_the_wall_clock(MissionFile& file, int threads) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  file.simulation.realtime = true;
  file.mission.background_workers = std::max(1, (threads > 0 ? threads : cores) - 1);
  file.compute_table = "wall-clock";
}

/// The home states of the sides a mission visits must exist before anything moves.
void check_sides(const MissionFile& file, const RobotModel& robot) {
  for (const auto& segment : file.mission.segments) {
    const std::string home = "side_" + std::to_string(segment.side);
    if (segment.side > robot.sides() || !robot.has_home(home)) {
      stop_with(kBadInput, {file.robot.string() + ": has no boxes or home state for " + home +
                            ", which the mission visits"});
    }
    const auto outside = [](const Joint& axis, double value) {
      return value < axis.lower - 1e-9 || value > axis.upper + 1e-9;
    };
    if (outside(robot.travel_axis(), segment.trolley.travel_m) ||
        outside(robot.lift_axis(), segment.trolley.lift_m)) {
      stop_with(kBadInput,
                {"stops_travel_m, lifts_m: " + segment.name +
                 " is beyond the limits of the trolley's axes in " + file.robot.string()});
    }
  }
}

/// Where unknown space blocks and nothing is known to be free, the arm could not leave its home.
void check_known_free(const MissionFile& file, const RobotModel& robot) {
  if (!file.mission.collision.unknown_blocks || !robot.setup().known_free.isEmpty()) return;
  stop_with(kBadInput,
            {file.robot.string() +
             ": 'collision.unknown: blocked' needs known_free here, a box in the frame of '" +
             robot.setup().base_link +
             "' in which there is nothing but the robot (the aisle, say): without it the arm "
             "cannot leave its home"});
}

}  // namespace

void run(const RunArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  MissionFile file = load(arguments.mission, overrides_of(arguments));
  if (arguments.realtime) run_on_the_wall_clock(file, arguments.threads);
  const RobotModel robot = value_or_stop(load_robot(file.robot, file.T_frame_camera), kBadInput);
  const ArmIk ik = value_or_stop(ArmIk::make(robot), kBadInput);
  check_sides(file, robot);
  check_known_free(file, robot);
  value_or_stop(make_detector(file.mission.detector), kBadInput);
  std::optional<tbb::global_control> threads;
  if (arguments.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(arguments.threads));
  }
  const std::filesystem::path out =
      arguments.out.empty()
          ? std::filesystem::path("out") / (file.mission.name + "-" + file.mission.planner +
                                            "-seed" + std::to_string(file.mission.seed))
          : std::filesystem::path(arguments.out);

  std::atomic<bool>& stop = catch_stop_signals();
  const ImportedScene world = build_world_or_stop(file.world, file.mission.seed, arguments.quiet);
  const Scene& scene = world.scene;
  const SegmentPlan& first = file.mission.segments.front();
  Simulation simulation(robot, scene, robot.home("side_" + std::to_string(first.side)),
                        first.trolley, file.simulation);
  Mission mission(robot, ik, simulation.judge().checker(), simulation.ports(), file.mission, stop);
  simulation.watch_map(&mission.map());
  ProgressBar bar(arguments.quiet);
  mission.on_progress([&](const MissionProgress& progress) {
    bar.show(progress.fraction, line_of(progress), progress.segment);
  });

  RecordWriter writer = value_or_stop(RecordWriter::create(out, header_of(file)), kFailed);
  const auto outcome = mission.run(writer);
  bar.finish();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const Summary summary =
      value_or_stop(write_results(out, header_of(file), mission, scene, elapsed()), kFailed);
  if (!arguments.quiet) print_summary(summary, out);
  if (arguments.profile) print_profile(mission.timer(), elapsed());
  if (!outcome) stop_with(kFailed, outcome.error());
  if (stop) {
    std::fprintf(stderr, "canopeer: interrupted; the results so far are in %s\n", out.c_str());
    throw Stop{kInterrupted};
  }
}

}  // namespace canopeer::app
