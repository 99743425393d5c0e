#pragma once

#include <cstdint>
#include <limits>

namespace canopeer {

/// Where nothing is seen.
inline constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

/// The triangle that a pixel shows.
struct VisibleSurface {
  std::uint32_t body = kNoSurface;  ///< 0: the world; 1 + i: its instance i; kNoSurface: the sky
  std::uint32_t triangle = 0;       ///< in the body's soup

  friend bool operator==(const VisibleSurface& a, const VisibleSurface& b) {
    return a.body == b.body && a.triangle == b.triangle;
  }
};

/// Neighbouring pixels of a row, begin … end, that show the same.
struct VisibleRun {
  std::uint32_t begin = 0, end = 0;
  VisibleSurface surface;
};

}  // namespace canopeer
