#pragma once

#include <numbers>

namespace canopeer {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180.0;  // rad

}  // namespace canopeer
