// The planner's kernels on one thread, in front of Scenario 1: planner_search_bench.cpp,
// planner_graph_bench.cpp and planner_judge_bench.cpp.

#include <vector>

#include "bench_rows.h"
#include "bench_threads.h"

int main(int argc, char** argv) {
  const canopeer::Threads one(1);
  using canopeer::BenchRow;
  const std::vector<BenchRow> rows = {
      {.name = "planner.expansions_cold",
       .ours = "expansions_cold",
       .baseline = "expansions_octomap",
       .unit = "1/s"},
      // By the clock: the search casts a node's neighbours in parallel.
      {.name = "planner.expansions_cold_two_threads",
       .ours = "expansions_cold_two_threads",
       .baseline = "expansions_octomap",
       .unit = "1/s"},
      {.name = "planner.expansions",
       .ours = "expansions",
       .baseline = "expansions_octomap",
       .unit = "1/s"},
      // The published graph builder: 92 nodes in 5 s of one thread.
      {.name = "planner.graph_1s",
       .ours = "graph_1s",
       .unit = "nodes",
       .counter = "nodes",
       .more_is_better = true,
       .stated = 92.0 / 5.0},
      {.name = "planner.graph_1s_degree",
       .ours = "graph_1s",
       .unit = "edges",
       .counter = "degree",
       .more_is_better = true},
      // Motions a second that the simulation judges, beside FCL on each of their states.
      {.name = "planner.judge_scenario_1",
       .ours = "judge_scenario_1",
       .baseline = "judge_scenario_1_plain",
       .unit = "1/s"},
      {.name = "planner.judge_dense_1",
       .ours = "judge_dense_1",
       .baseline = "judge_dense_1_plain",
       .unit = "1/s"},
      {.name = "planner.judge_stop",
       .ours = "judge_stop",
       .baseline = "judge_stop_plain",
       .unit = "ms"},
      {.name = "planner.replan_p95", .ours = "replan", .unit = "p95_ms", .counter = "p95_ms"},
      // Of it, without detecting the fruit pixels and fusing the frame.
      {.name = "planner.replan_after_fusing_p95",
       .ours = "replan",
       .unit = "p95_ms",
       .counter = "after_fusing_p95_ms"},
  };
  return canopeer::run_benchmarks(argc, argv, rows);
}
