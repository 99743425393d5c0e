// Perception beside planning, on two cores by the clock (perception_stream.cpp), and its steps on
// one thread in processor time (perception_steps.cpp): a film of Scenario 1 at 1 cm voxels.

#include <sched.h>

#include <string>
#include <vector>

#include "bench_rows.h"
#include "bench_threads.h"

namespace {

/// The first two processors of those that this process may use.
void keep_to_two_cores() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  cpu_set_t two;
  CPU_ZERO(&two);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&two) < 2; ++cpu) {
    if (CPU_ISSET(cpu, &allowed)) CPU_SET(cpu, &two);
  }
  static_cast<void>(sched_setaffinity(0, sizeof two, &two));
}

/// Frames a second that are known, with their fruits, while a graph grows and a search runs; beside
/// it the same with distances, targets and the planner's turn after each frame.
canopeer::BenchRow sustained(const std::string& by) {
  return {.name = "perception.sustained_hz" + by,
          .ours = "sustained_merged" + by,
          .baseline = "sustained_one_by_one" + by,
          .unit = "Hz",
          .counter = "hz",
          .more_is_better = true};
}

/// From a frame's arrival, 15 a second, until fruits and map know it.
canopeer::BenchRow latency(const std::string& by) {
  return {.name = "perception.latency_p95" + by,
          .ours = "latency" + by,
          .unit = "p95_ms",
          .counter = "p95_ms"};
}

/// Of those frames the share for which there was no room.
canopeer::BenchRow late(const std::string& by) {
  return {.name = "perception.late" + by,
          .ours = "latency" + by,
          .unit = "%",
          .counter = "late_percent"};
}

/// Of the two that the process had by the clock: less where others were at work.
canopeer::BenchRow cores(const std::string& of, const std::string& run) {
  return {.name = "perception." + of + "_cores",
          .ours = run,
          .unit = "cores",
          .counter = "cores",
          .more_is_better = true};
}

canopeer::BenchRow step(const std::string& name) {
  return {.name = "perception." + name, .ours = "steps", .unit = "cpu_ms", .counter = name + "_ms"};
}

}  // namespace

int main(int argc, char** argv) {
  keep_to_two_cores();
  const canopeer::Threads one(1);
  using canopeer::BenchRow;
  const std::vector<BenchRow> rows = {
      // By the clock, and what it would say if nobody else used the two cores.
      sustained(""),
      cores("sustained", "sustained_merged"),
      sustained("_cpu"),
      latency(""),
      late(""),
      cores("latency", "latency"),
      latency("_cpu"),
      late("_cpu"),
      // One thread. Of each frame:
      step("detect"),
      step("fuse"),
      step("fruit_map"),
      // After four of them:
      step("distances"),
      step("targets"),
      step("snapshot"),
      step("map_changed"),
      // All together, of each frame.
      {.name = "perception.frame",
       .ours = "frame_merged",
       .baseline = "frame_as_view",
       .unit = "cpu_ms",
       .counter = "frame_ms"},
  };
  return canopeer::run_benchmarks(argc, argv, rows);
}
