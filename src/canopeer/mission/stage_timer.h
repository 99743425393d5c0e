#pragma once

#include <chrono>
#include <map>
#include <string>

namespace canopeer {

/// Wall-clock seconds spent in each stage of a run, for people who want to know where the time
/// goes. Never part of a record.
class StageTimer {
 public:
  /// Runs `work` and adds its duration to `stage`.
  template <typename Work>
  decltype(auto) time(const std::string& stage, Work&& work) {
    const Stopwatch watch{seconds_[stage]};
    return work();
  }
  void add(const StageTimer& other) {
    for (const auto& [stage, seconds] : other.seconds_) seconds_[stage] += seconds;
  }
  [[nodiscard]] const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  struct Stopwatch {
    double& total;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    explicit Stopwatch(double& sum) : total(sum) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() {
      total += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
  };
  std::map<std::string, double> seconds_;
};

}  // namespace canopeer
