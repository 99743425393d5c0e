#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace canopeer {

/// Between sRGB values and the light they stand for, 0 … 65535 (IEC 61966-2-1). Light adds up,
/// values do not. Every value comes back from its light.
class LinearLight {
 public:
  LinearLight();

  [[nodiscard]] std::uint16_t of(std::uint8_t value) const { return light_[value]; }
  /// The value whose light is nearest, as seen by sRGB.
  [[nodiscard]] std::uint8_t value(std::uint16_t light) const { return value_[light]; }

 private:
  std::array<std::uint16_t, 256> light_{};
  std::vector<std::uint8_t> value_;  // of each light
};

/// The tables, made once.
[[nodiscard]] const LinearLight& linear_light();

}  // namespace canopeer
