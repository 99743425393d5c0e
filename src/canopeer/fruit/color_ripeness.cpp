#include "canopeer/fruit/color_ripeness.h"

#include <algorithm>
#include <array>

namespace canopeer {
namespace {

constexpr double kMinSaturation = 0.2;
constexpr double kMinValue = 0.1;
constexpr double kMinShare = 0.2;  // of the surface, that tells

/// In (−60°, 300°], red 0°; only for colours that are no grey.
double hue_deg(const Rgb& c, double largest, double spread) {
  if (c.r == largest) return 60.0 * (c.g - c.b) / spread;
  if (c.g == largest) return 120.0 + 60.0 * (c.b - c.r) / spread;
  return 240.0 + 60.0 * (c.r - c.g) / spread;
}

}  // namespace

PixelLabel ripeness_of_color(const Rgb& color) {
  const double largest = std::max({color.r, color.g, color.b});
  const double spread = largest - std::min({color.r, color.g, color.b});
  if (largest < 255.0 * kMinValue || spread < kMinSaturation * largest) {
    return PixelLabel::background;
  }
  const double hue = hue_deg(color, largest, spread);
  if (hue < -30.0 || hue >= 170.0) return PixelLabel::background;
  return hue < 14.5   ? PixelLabel::ripe_fruit
         : hue < 50.0 ? PixelLabel::turning_fruit
                      : PixelLabel::green_fruit;
}

PixelLabel ripeness_of_surface(const std::vector<Rgb>& colors) {
  std::array<std::size_t, 4> votes{};  // by label
  for (const Rgb& color : colors) ++votes[static_cast<std::size_t>(ripeness_of_color(color))];
  const std::size_t told = colors.size() - votes[0];
  if (told == 0 || static_cast<double>(told) < kMinShare * static_cast<double>(colors.size())) {
    return PixelLabel::background;
  }
  return static_cast<PixelLabel>(std::max_element(votes.begin() + 1, votes.end()) - votes.begin());
}

}  // namespace canopeer
