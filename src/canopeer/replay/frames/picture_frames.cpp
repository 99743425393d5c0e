#include "canopeer/replay/frames/picture_frames.h"

#include <algorithm>
#include <limits>

#include "canopeer/replay/frames/frame_head.h"
#include "canopeer/sensing/jpeg.h"
#include "canopeer/sensing/png.h"

namespace canopeer::frames {
namespace {

constexpr int kColorWidth = 320;
constexpr int kDepthWidth = 160;
constexpr int kQuality = 60;

/// So many pixels become one.
int shrink_factor(int width, int wanted) { return std::max(1, width / wanted); }

/// Means of squares of `factor` pixels.
ColorImage shrink(const ColorImage& image, int factor) {
  ColorImage small(image.width() / factor, image.height() / factor);
  for (int v = 0; v < small.height(); ++v) {
    for (int u = 0; u < small.width(); ++u) {
      int sum[3] = {0, 0, 0};
      for (int y = v * factor; y < (v + 1) * factor; ++y) {
        for (int x = u * factor; x < (u + 1) * factor; ++x) {
          const Rgb& c = image.at(x, y);
          sum[0] += c.r;
          sum[1] += c.g;
          sum[2] += c.b;
        }
      }
      const auto mean = [&](int s) { return static_cast<std::uint8_t>(s / (factor * factor)); };
      small.at(u, v) = {mean(sum[0]), mean(sum[1]), mean(sum[2])};
    }
  }
  return small;
}

Json picture_head(int view, const char* what, int width, int height, const char* mime) {
  Json head = head_of("picture");
  head["view"] = view;
  head["what"] = what;
  head["width"] = width;
  head["height"] = height;
  head["mime"] = mime;
  return head;
}

Frame color_picture(int view, const ColorImage& color) {
  const ColorImage small = shrink(color, shrink_factor(color.width(), kColorWidth));
  return frame_of(picture_head(view, "color", small.width(), small.height(), "image/jpeg"),
                  encode_jpeg(small, kQuality));
}

/// The middle pixel of each square: means of depth would make surfaces that are not there.
Frame depth_picture(int view, const DepthImage& depth) {
  const int factor = shrink_factor(depth.width(), kDepthWidth);
  Mask grey(depth.width() / factor, depth.height() / factor);
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = 0.0F;
  const auto at = [&](int u, int v) {
    return depth.at(u * factor + factor / 2, v * factor + factor / 2);
  };
  for (int v = 0; v < grey.height(); ++v) {
    for (int u = 0; u < grey.width(); ++u) {
      const float d = at(u, v);
      if (!(d > 0.0F)) continue;
      nearest = std::min(nearest, d);
      farthest = std::max(farthest, d);
    }
  }
  const float range = std::max(farthest - nearest, 1e-3F);
  for (int v = 0; v < grey.height(); ++v) {
    for (int u = 0; u < grey.width(); ++u) {
      const float d = at(u, v);
      if (d > 0.0F)
        grey.at(u, v) = static_cast<std::uint8_t>(1.5F + 254.0F * (d - nearest) / range);
    }
  }
  Json head = picture_head(view, "depth", grey.width(), grey.height(), "image/png");
  head["min_m"] = farthest > 0.0F ? rounded(static_cast<double>(nearest), 1e-3) : 0.0;
  head["max_m"] = rounded(static_cast<double>(farthest), 1e-3);
  return frame_of(head, encode_png(grey));
}

/// Fruit where any pixel of a square is.
Frame fruit_picture(int view, const Mask& fruit) {
  const int factor = shrink_factor(fruit.width(), kDepthWidth);
  Mask small(fruit.width() / factor, fruit.height() / factor);
  for (int v = 0; v < small.height() * factor; ++v) {
    for (int u = 0; u < small.width() * factor; ++u) {
      if (fruit.at(u, v) != 0) small.at(u / factor, v / factor) = 255;
    }
  }
  return frame_of(picture_head(view, "fruit", small.width(), small.height(), "image/png"),
                  encode_png(small));
}

}  // namespace

std::vector<Frame> picture_frames(int view, const RgbdFrame& frame, const Detection& detection) {
  std::vector<Frame> pictures;
  if (!frame.color.empty()) pictures.push_back(color_picture(view, frame.color));
  if (!frame.depth.empty()) pictures.push_back(depth_picture(view, frame.depth));
  if (!detection.fruit.empty()) pictures.push_back(fruit_picture(view, detection.fruit));
  return pictures;
}

}  // namespace canopeer::frames
