#include "canopeer/scene/plants/plant_colors.h"

#include <algorithm>
#include <cmath>

#include "canopeer/scene/plants/statistics.h"

namespace canopeer {
namespace {

// Measured mean colours of the paper's plants.
constexpr Rgb kRipe{204, 41, 9};
constexpr Rgb kTurning{227, 88, 23};
constexpr Rgb kGreenFruit{162, 154, 35};
constexpr Rgb kLeaf{60, 83, 22};
constexpr Rgb kStem{101, 118, 40};

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Rgb mix(Rgb a, Rgb b, double t) {
  const auto lerp = [t](std::uint8_t x, std::uint8_t y) { return channel((1.0 - t) * x + t * y); };
  return {lerp(a.r, b.r), lerp(a.g, b.g), lerp(a.b, b.b)};
}

}  // namespace

Rgb vary_color(Rgb base, double brightness_sd, double channel_sd, Rng& rng) {
  const double brightness =
      clipped_normal(rng, 1.0, brightness_sd, 1.0 - 2.0 * brightness_sd, 1.0 + 2.0 * brightness_sd);
  const auto vary = [&](std::uint8_t c) {
    return channel(
        c * brightness *
        clipped_normal(rng, 1.0, channel_sd, 1.0 - 2.0 * channel_sd, 1.0 + 2.0 * channel_sd));
  };
  const std::uint8_t r = vary(base.r);
  const std::uint8_t g = vary(base.g);
  const std::uint8_t b = vary(base.b);
  return {r, g, b};
}

Rgb leaf_color(double below_tip_m, Rng& rng) {
  // Young leaves are lighter and yellower than the mean, old ones a little darker.
  constexpr Rgb kYoung{96, 128, 36};
  constexpr Rgb kOld{54, 78, 21};
  const double age = std::clamp(below_tip_m / 0.25, 0.0, 1.0);
  return vary_color(mix(kYoung, mix(kOld, kLeaf, 0.3), age), 0.13, 0.05, rng);
}

Rgb stem_color(Rng& rng) { return vary_color(kStem, 0.08, 0.04, rng); }

Rgb calyx_color(Rng& rng) { return vary_color(mix(kStem, kLeaf, 0.4), 0.08, 0.04, rng); }

Rgb fruit_color(Ripeness ripeness, Rng& rng) {
  switch (ripeness) {
    case Ripeness::green:
      return vary_color(mix(kGreenFruit, kLeaf, rng.uniform(-0.15, 0.35)), 0.06, 0.04, rng);
    case Ripeness::turning:
      return vary_color(mix(kTurning, kRipe, rng.uniform(-0.25, 0.25)), 0.05, 0.05, rng);
    case Ripeness::ripe:
      break;
  }
  return vary_color(kRipe, 0.08, 0.06, rng);
}

}  // namespace canopeer
