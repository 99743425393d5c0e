#include "bench_rows.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace canopeer {
namespace {

struct Measured {
  double seconds = 0;  // of one iteration: CPU time, or by the clock if the run asks for it
  double items_per_s = 0;
  std::map<std::string, double> counters{};
};

/// Whether the run was given up; Google Benchmark 1.8 (Debian 13) says it in another word.
template <typename Run>
bool given_up(const Run& run) {
  if constexpr (requires { run.error_occurred; }) {
    return run.error_occurred;
  } else {
    return run.skipped != 0;
  }
}

// Prints like the console reporter and keeps the best repetition of every run.
class Collector : public benchmark::ConsoleReporter {
 public:
  Collector() : ConsoleReporter(OO_None) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !given_up(run)) keep(run);
    }
  }

  const Measured* find(const std::string& name) const {
    const auto found = best_.find(name);
    return found == best_.end() ? nullptr : &found->second;
  }

 private:
  void keep(const Run& run) {
    const double iterations =
        static_cast<double>(std::max<benchmark::IterationCount>(1, run.iterations));
    Measured one;
    const bool by_the_clock =
        run.run_name.time_type == "real_time" || run.run_name.time_type == "manual_time";
    one.seconds =
        (by_the_clock ? run.real_accumulated_time : run.cpu_accumulated_time) / iterations;
    one.items_per_s = 1 / one.seconds;
    for (const auto& [name, counter] : run.counters) {
      if (name == "items_per_second") one.items_per_s = counter.value;
      one.counters[name] = counter.value;
    }
    const auto [place, is_new] = best_.try_emplace(base_name(run), one);
    if (!is_new && one.seconds < place->second.seconds) place->second = one;
  }

  // The name the source gives the run: without "/repeats:3", "/iterations:1", "/process_time" …
  static std::string base_name(const Run& run) {
    const auto& name = run.run_name;
    return name.args.empty() ? name.function_name : name.function_name + "/" + name.args;
  }

  std::map<std::string, Measured> best_;
};

bool is_time(const std::string& unit) {
  return unit == "s" || unit == "ms" || unit == "us" || unit == "ns";
}

double value_of(const Measured& run, const BenchRow& row) {
  if (!row.counter.empty()) return run.counters.at(row.counter);
  if (row.unit == "1/s") return run.items_per_s;
  return run.seconds * (row.unit == "ns"   ? 1e9
                        : row.unit == "us" ? 1e6
                        : row.unit == "ms" ? 1e3
                                           : 1);
}

nlohmann::ordered_json row_json(const BenchRow& row, const Collector& runs) {
  const double value = value_of(*runs.find(row.ours), row);
  std::optional<double> other = row.stated;
  if (const Measured* baseline = runs.find(row.baseline)) other = value_of(*baseline, row);
  const bool more_is_better = row.counter.empty() ? !is_time(row.unit) : row.more_is_better;
  nlohmann::ordered_json json = {{"name", row.name}, {"value", value}, {"unit", row.unit}};
  json["baseline"] = row.stated ? "stated" : row.baseline;
  json["baseline_value"] = nullptr;
  json["ratio"] = nullptr;
  if (other) {
    json["baseline_value"] = *other;
    json["ratio"] = more_is_better ? value / *other : *other / value;
  }
  return json;
}

void print_row(const nlohmann::ordered_json& row) {
  const auto text = [&row](const char* key) -> std::string {
    return row[key].is_null() ? "-"
           : row[key].is_string()
               ? row[key].get<std::string>()
               : [&] {
                   char number[32];
                   std::snprintf(number, sizeof number, "%.4g", row[key].get<double>());
                   return std::string(number);
                 }();
  };
  std::printf("%-28s %12s %-6s %-28s %12s %10s\n", text("name").c_str(), text("value").c_str(),
              text("unit").c_str(), text("baseline").c_str(), text("baseline_value").c_str(),
              text("ratio").c_str());
}

// Takes "--json FILE" out of the arguments.
std::optional<std::string> take_json_option(std::vector<char*>& arguments) {
  for (std::size_t i = 1; i + 1 < arguments.size(); ++i) {
    if (std::string(arguments[i]) != "--json") continue;
    const std::string file = arguments[i + 1];
    arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i),
                    arguments.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    return file;
  }
  return std::nullopt;
}

}  // namespace

int run_benchmarks(int argc, char** argv, const std::vector<BenchRow>& rows) {
  std::vector<char*> arguments(argv, argv + argc);
  const std::optional<std::string> json_file = take_json_option(arguments);
  std::string repetitions = "--benchmark_repetitions=3";
  arguments.insert(arguments.begin() + 1, repetitions.data());  // a later one wins
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  Collector runs;
  benchmark::RunSpecifiedBenchmarks(&runs);
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  for (const BenchRow& row : rows) {
    if (runs.find(row.ours) != nullptr) table.push_back(row_json(row, runs));
  }
  std::printf("\n%-28s %12s %-6s %-28s %12s %10s\n", "row", "value", "unit", "baseline",
              "its value", "ratio");
  for (const auto& row : table) print_row(row);
  if (!json_file) return 0;
  std::ofstream out(*json_file);
  out << table.dump(2) << '\n';
  out.flush();
  if (out) return 0;
  std::fprintf(stderr, "cannot write '%s'\n", json_file->c_str());
  return 2;
}

}  // namespace canopeer
