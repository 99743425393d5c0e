#pragma once

#include <optional>
#include <string>
#include <vector>

namespace canopeer {

// One row of a benchmark: what a Google Benchmark run of this program measured, beside its
// baseline. Times are CPU time of one iteration (by the clock in runs with UseRealTime(), what the
// run says with UseManualTime()), the best of all repetitions, because the machines are shared.
struct BenchRow {
  std::string name{};  // "map.fuse_projective"
  std::string ours{};  // the run's name as Google Benchmark prints it: "fuse_next", "view_cast/63"
  std::string baseline{};  // the baseline's run; empty when there is none or `stated` is given
  // "s", "ms", "us", "ns": time per iteration. "1/s": iterations (or items, when the run counts
  // them with SetItemsProcessed) per second. Anything else: the value of the counter `counter`.
  std::string unit{};
  std::string counter{};
  bool more_is_better = false;     // of counters; times and rates know it themselves
  std::optional<double> stated{};  // a baseline measured elsewhere, in the row's unit
};

// The `main` of a benchmark program: runs the registered benchmarks (three repetitions each unless
// --benchmark_repetitions says otherwise), prints the table of rows, and writes them with --json
// FILE as [{"name", "value", "unit", "baseline", "baseline_value", "ratio"}]; ratio > 1: we are
// better; null where there is no baseline. Rows whose runs were filtered out (--benchmark_filter)
// are left out. Returns the exit status: 2 for bad arguments or a file that cannot be written.
int run_benchmarks(int argc, char** argv, const std::vector<BenchRow>& rows);

}  // namespace canopeer
