#pragma once

#include <cstdint>
#include <string_view>

namespace canopeer {

/// Seeded random stream: xoshiro256++ (Blackman & Vigna 2021), state filled by SplitMix64 from
/// (seed, stream). The same on every platform and standard library, which std::distributions are
/// not. Not thread-safe: give each task its own stream.
class Rng {
 public:
  explicit Rng(std::uint64_t seed, std::uint64_t stream = 0);
  /// A stream named by a word and a number, e.g. Rng(seed, "plant", 7).
  Rng(std::uint64_t seed, std::string_view name, std::uint64_t index = 0);

  std::uint64_t bits();
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Normal by Box–Muller (two uniforms a call).
  double normal(double mean = 0.0, double standard_deviation = 1.0);
  /// Uniform in 0 … count − 1; count > 0.
  std::uint64_t index(std::uint64_t count);
  bool chance(double probability) { return uniform() < probability; }

  template <typename Archive>
  void serialize(Archive& archive) {
    for (std::uint64_t& word : state_) archive(word);
  }

 private:
  std::uint64_t state_[4];
};

}  // namespace canopeer
