#include "canopeer/base/rng.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace canopeer {
namespace {

std::uint64_t split_mix(std::uint64_t& x) {
  std::uint64_t z = (x += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::uint64_t hash_name(std::string_view name) {  // FNV-1a
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return h;
}

}  // namespace

Rng::Rng(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t a = seed;
  std::uint64_t b = split_mix(a) ^ (stream * 0xd1342543de82ef95ULL + 0x2545f4914f6cdd1dULL);
  for (auto& word : state_) word = split_mix(b);
}

Rng::Rng(std::uint64_t seed, std::string_view name, std::uint64_t index)
    : Rng(seed, hash_name(name) + index * 0x9e3779b97f4a7c15ULL) {}

std::uint64_t Rng::bits() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Rng::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double Rng::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Rng::normal(double mean, double standard_deviation) {
  const double u = 1.0 - uniform();  // in (0, 1]
  const double v = uniform();
  return mean +
         standard_deviation * std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

std::uint64_t Rng::index(std::uint64_t count) {
  __extension__ using Wide = unsigned __int128;  // of the compiler, not of ISO C++
  return static_cast<std::uint64_t>((static_cast<Wide>(bits()) * count) >> 64);
}

}  // namespace canopeer
