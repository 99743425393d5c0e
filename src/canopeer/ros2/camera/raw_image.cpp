#include "canopeer/ros2/camera/raw_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "canopeer/base/byte_order.h"
#include "canopeer/sensing/png.h"

namespace canopeer::ros {
namespace {

/// A message whose rows are all there.
struct Rows {
  int width = 0;
  int height = 0;
  const std::uint8_t* data = nullptr;
  std::size_t step = 0;
  [[nodiscard]] const std::uint8_t* row(int v) const {
    return data + static_cast<std::size_t>(v) * step;
  }
};

Expected<Rows> rows_of(const sensor_msgs::Image& message, std::size_t pixel_octets) {
  if (auto size = check_image_size(message.width, message.height); !size) {
    return tl::unexpected(size.error());
  }
  const std::size_t row = message.width * pixel_octets;
  const std::size_t needed = (message.height - 1) * std::size_t{message.step} + row;
  if (message.step < row || message.data.size() < needed) {
    return fail("an image of " + std::to_string(message.width) + " x " +
                std::to_string(message.height) + " " + message.encoding + " with rows of " +
                std::to_string(message.step) + " octets and " +
                std::to_string(message.data.size()) + " octets in all: damaged");
  }
  return Rows{static_cast<int>(message.width), static_cast<int>(message.height),
              message.data.data(), message.step};
}

/// Where red, green and blue lie in a pixel.
struct ColorLayout {
  const char* encoding;
  std::size_t octets;
  std::array<std::size_t, 3> rgb;
};
constexpr std::array<ColorLayout, 6> kColorLayouts = {{{"rgb8", 3, {0, 1, 2}},
                                                       {"bgr8", 3, {2, 1, 0}},
                                                       {"rgba8", 4, {0, 1, 2}},
                                                       {"bgra8", 4, {2, 1, 0}},
                                                       {"mono8", 1, {0, 0, 0}},
                                                       {"8UC3", 3, {2, 1, 0}}}};  // OpenCV's order

bool grey8(const std::string& encoding) { return encoding == "mono8" || encoding == "8UC1"; }

/// `pixel(row, u)` of all pixels.
template <typename T, typename Pixel>
Image<T> each_pixel(const Rows& rows, Pixel pixel) {
  Image<T> image(rows.width, rows.height);
  for (int v = 0; v < rows.height; ++v) {
    const std::uint8_t* const row = rows.row(v);
    T* const out = image.pixels().data() + static_cast<std::size_t>(v) * rows.width;
    for (int u = 0; u < rows.width; ++u) out[u] = pixel(row, u);
  }
  return image;
}

template <typename T>
T number_at(const std::uint8_t* row, int u, ByteOrder order) {
  const std::uint8_t* const octets = row + sizeof(T) * static_cast<std::size_t>(u);
  if (order == ByteOrder::big) return load_number<T>(reinterpret_cast<const char*>(octets), order);
  T value;
  std::memcpy(&value, octets, sizeof value);
  return value;
}

ByteOrder order_of(const sensor_msgs::Image& message) {
  return message.is_bigendian != 0 ? ByteOrder::big : ByteOrder::little;
}

}  // namespace

Expected<void> check_image_size(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t kMostPixelsAcross = 1u << 16;
  if (width == 0 || height == 0) return fail("an image without pixels");
  if (width > kMostPixelsAcross || height > kMostPixelsAcross ||
      width * height > kMostImagePixels) {
    return fail("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels; at most " + std::to_string(kMostImagePixels) + " are taken");
  }
  return {};
}

Expected<ColorImage> color_of(const sensor_msgs::Image& message) {
  const auto layout =
      std::find_if(kColorLayouts.begin(), kColorLayouts.end(),
                   [&](const ColorLayout& known) { return known.encoding == message.encoding; });
  if (layout == kColorLayouts.end()) {
    return fail("colour images are '" + message.encoding +
                "'; set the camera driver to rgb8 (bgr8, rgba8, bgra8 and mono8 are read too)");
  }
  const auto rows = rows_of(message, layout->octets);
  if (!rows) return tl::unexpected(rows.error());
  const std::size_t octets = layout->octets;
  const auto [r, g, b] = layout->rgb;
  return each_pixel<Rgb>(*rows, [=, r = r, g = g, b = b](const std::uint8_t* row, int u) {
    const std::uint8_t* const pixel = row + octets * static_cast<std::size_t>(u);
    return Rgb{pixel[r], pixel[g], pixel[b]};
  });
}

Expected<DepthImage> depth_of(const sensor_msgs::Image& message) {
  const ByteOrder order = order_of(message);
  if (message.encoding == "16UC1" || message.encoding == "mono16") {
    const auto rows = rows_of(message, 2);
    if (!rows) return tl::unexpected(rows.error());
    return each_pixel<float>(*rows, [order](const std::uint8_t* row, int u) {
      return depth_of_units(number_at<std::uint16_t>(row, u, order), 1000.0);
    });
  }
  if (message.encoding == "32FC1") {
    const auto rows = rows_of(message, 4);
    if (!rows) return tl::unexpected(rows.error());
    return each_pixel<float>(*rows, [order](const std::uint8_t* row, int u) {
      const auto depth = number_at<float>(row, u, order);
      return depth > 0.0F && std::isfinite(depth) ? depth : 0.0F;
    });
  }
  return fail("depth images are '" + message.encoding +
              "'; set the camera driver to 16UC1 (mm) or 32FC1 (m)");
}

Expected<Image<PixelLabel>> labels_from(int width, int height, const std::uint8_t* values,
                                        std::size_t step) {
  std::uint8_t highest = 0;
  auto labels = each_pixel<PixelLabel>(Rows{width, height, values, step},
                                       [&](const std::uint8_t* row, int u) {
                                         highest = std::max(highest, row[u]);
                                         return static_cast<PixelLabel>(row[u]);
                                       });
  if (highest > static_cast<std::uint8_t>(PixelLabel::ripe_fruit)) {
    return fail("a label image has the value " + std::to_string(highest) +
                "; labels are 0 (background), 1 (green), 2 (turning) and 3 (ripe fruit)");
  }
  return labels;
}

Expected<Image<PixelLabel>> labels_of(const sensor_msgs::Image& message) {
  if (!grey8(message.encoding)) {
    return fail("label images are '" + message.encoding + "'; they must be mono8 or 8UC1");
  }
  const auto rows = rows_of(message, 1);
  if (!rows) return tl::unexpected(rows.error());
  return labels_from(rows->width, rows->height, rows->data, rows->step);
}

Expected<Image<float>> confidences_of(const sensor_msgs::Image& message) {
  if (grey8(message.encoding)) {
    const auto rows = rows_of(message, 1);
    if (!rows) return tl::unexpected(rows.error());
    return each_pixel<float>(
        *rows, [](const std::uint8_t* row, int u) { return static_cast<float>(row[u]) / 255.0F; });
  }
  if (message.encoding != "32FC1") {
    return fail("confidence images are '" + message.encoding +
                "'; they must be 32FC1 (0 ... 1) or mono8 (0 ... 255)");
  }
  const auto rows = rows_of(message, 4);
  if (!rows) return tl::unexpected(rows.error());
  return each_pixel<float>(*rows, [order = order_of(message)](const std::uint8_t* row, int u) {
    const auto value = number_at<float>(row, u, order);
    return value > 0.0F ? std::min(value, 1.0F) : 0.0F;
  });
}

}  // namespace canopeer::ros
