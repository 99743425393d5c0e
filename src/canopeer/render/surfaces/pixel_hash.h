#pragma once

#include <cstdint>

namespace canopeer {

/// Well-mixed 64 bits from any 64 bits (the finaliser of SplitMix64). The noise depends on nothing
/// but its argument, so pixels can be shaded in any order.
inline std::uint64_t pixel_hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace canopeer
