#include "canopeer/ros2/out/detection_picture.h"

#include <algorithm>
#include <cmath>

#include "canopeer/ros2/out/label_colors.h"

namespace canopeer::ros {
namespace {

ColorImage colors_or_grey(const RgbdFrame& frame) {
  if (!frame.color.empty()) return frame.color;
  ColorImage grey(frame.depth.width(), frame.depth.height());
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    const auto depth = static_cast<double>(frame.depth.pixels()[i]);
    if (!(depth > 0.0)) continue;  // no return stays black
    const double nearness = 1.0 - std::min(depth / frame.intrinsics.max_range_m, 1.0);
    const auto level = static_cast<std::uint8_t>(60.0 + 195.0 * nearness);
    grey.pixels()[i] = {level, level, level};
  }
  return grey;
}

/// A fruit pixel beside one that is none, or beside the image's edge.
bool on_outline(const Mask& fruit, int u, int v) {
  if (u == 0 || v == 0 || u + 1 == fruit.width() || v + 1 == fruit.height()) return true;
  return fruit.at(u - 1, v) == 0 || fruit.at(u + 1, v) == 0 || fruit.at(u, v - 1) == 0 ||
         fruit.at(u, v + 1) == 0;
}

std::uint8_t mean(std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>((a + b) / 2); }

void tint(ColorImage& picture, const Mask& fruit) {
  for (int v = 0; v < fruit.height(); ++v) {
    for (int u = 0; u < fruit.width(); ++u) {
      if (fruit.at(u, v) == 0) continue;
      const Rgb color = label_color(static_cast<PixelLabel>(fruit.at(u, v)));
      Rgb& pixel = picture.at(u, v);
      pixel = on_outline(fruit, u, v)
                  ? color
                  : Rgb{mean(pixel.r, color.r), mean(pixel.g, color.g), mean(pixel.b, color.b)};
    }
  }
}

}  // namespace

sensor_msgs::Image detection_picture(const RgbdFrame& frame, const Detection& detection,
                                     const std_msgs::Header& header) {
  ColorImage picture = colors_or_grey(frame);
  if (detection.fruit.width() == picture.width() && detection.fruit.height() == picture.height()) {
    tint(picture, detection.fruit);
  }
  sensor_msgs::Image image;
  image.header = header;
  image.height = static_cast<std::uint32_t>(picture.height());
  image.width = static_cast<std::uint32_t>(picture.width());
  image.encoding = "rgb8";
  image.step = 3 * image.width;
  image.data.reserve(static_cast<std::size_t>(image.step) * image.height);
  for (const Rgb& pixel : picture.pixels()) {
    image.data.insert(image.data.end(), {pixel.r, pixel.g, pixel.b});
  }
  return image;
}

}  // namespace canopeer::ros
