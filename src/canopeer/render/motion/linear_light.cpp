#include "canopeer/render/motion/linear_light.h"

#include <cmath>

namespace canopeer {
namespace {

/// Light 0 … 1 of an sRGB value 0 … 1.
double light_of(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

}  // namespace

LinearLight::LinearLight() : value_(65536) {
  for (int i = 0; i < 256; ++i) {
    light_[static_cast<std::size_t>(i)] =
        static_cast<std::uint16_t>(std::lround(65535.0 * light_of(i / 255.0)));
  }
  int value = 0;
  for (int light = 0; light < 65536; ++light) {
    while (value < 255 && light >= std::lround(65535.0 * light_of((value + 0.5) / 255.0))) ++value;
    value_[static_cast<std::size_t>(light)] = static_cast<std::uint8_t>(value);
  }
}

const LinearLight& linear_light() {
  static const LinearLight kTables;
  return kTables;
}

}  // namespace canopeer
