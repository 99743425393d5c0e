#include "canopeer/ros2/camera/frame_assembly.h"

#include <algorithm>
#include <utility>

#include "canopeer/cdr/cdr.h"
#include "canopeer/ros2/camera/compressed_image.h"
#include "canopeer/ros2/camera/organised_cloud.h"
#include "canopeer/ros2/camera/raw_image.h"

namespace canopeer::ros {
namespace {

/// Calls `decode` with the image message that a part is.
template <class Pixels, class Decode>
Expected<Pixels> decoded(const PartMessage& message, Decode decode) {
  if (const auto* raw = std::get_if<sensor_msgs::Image>(&message)) return decode(*raw);
  if (const auto* packed = std::get_if<sensor_msgs::CompressedImage>(&message)) {
    return decode(*packed);
  }
  return fail("a cloud where an image was expected");
}

/// Each pixel of the result is the one whose place it has; nothing is mixed.
template <class T>
Image<T> resized(Image<T> image, int width, int height) {
  if (image.width() == width && image.height() == height) return image;
  Image<T> other(width, height);
  for (int v = 0; v < height; ++v) {
    const int from_v = static_cast<int>((v + 0.5) * image.height() / height);
    for (int u = 0; u < width; ++u) {
      other.at(u, v) = image.at(static_cast<int>((u + 0.5) * image.width() / width), from_v);
    }
  }
  return other;
}

template <class T>
Image<T> without_lens(Image<T> image, const CameraModel& model, T outside) {
  return model.without_lens ? model.without_lens->apply(image, outside) : std::move(image);
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

bool same_shape(int width, int height, int other_width, int other_height) {
  constexpr double kTolerance = 0.01;
  const double ratio = static_cast<double>(width) * other_height / height / other_width;
  return std::abs(ratio - 1.0) < kTolerance;
}

/// Whether depth is seen from where the colour is seen.
Expected<void> check_registration(const FrameMessages& messages, bool said_by_name) {
  const std::string& depth = header_of(*messages.part(FramePart::depth)).frame_id;
  const std::string& color = header_of(*messages.part(FramePart::color)).frame_id;
  if (said_by_name || depth.empty() || color.empty() || depth == color) return {};
  return fail("depth is seen from '" + depth + "' and colour from '" + color +
              "': have the driver register depth to colour (RealSense: align_depth.enable, then "
              "depth: .../aligned_depth_to_color/image_raw; others: depth_image_proc register)");
}

void keep_range(DepthImage& depth, double min_m, double max_m) {
  const auto nearest = static_cast<float>(min_m), farthest = static_cast<float>(max_m);
  for (float& d : depth.pixels()) {
    if (!(d >= nearest && d <= farthest)) d = 0.0F;
  }
}

}  // namespace

FrameAssemblyOptions assembly_options(const std::string& color_topic,
                                      const std::string& depth_topic) {
  const auto has = [](const std::string& topic, const char* word) {
    return topic.find(word) != std::string::npos;
  };
  FrameAssemblyOptions options;
  options.color_is_raw = !has(color_topic, "rect");
  options.depth_is_raw = !has(depth_topic, "rect");
  options.depth_is_registered =
      has(depth_topic, "aligned_depth_to_color") || has(depth_topic, "registered");
  return options;
}

Expected<CameraModel> FrameAssembler::model(const sensor_msgs::CameraInfo& info, int width,
                                            int height, bool raw) {
  sensor_msgs::CameraInfo key = info;
  key.header = {};
  key.roi.do_rectify = raw;
  const Payload bytes = to_cdr(key);
  for (const Known& known : known_) {
    if (known.width == width && known.height == height && known.info == bytes) return known.model;
  }
  auto made = camera_model(info, width, height, raw);
  if (!made) return made;
  constexpr std::size_t kMostKnown = 8;
  if (known_.size() == kMostKnown) known_.erase(known_.begin());
  known_.push_back({bytes, width, height, *made});
  return made;
}

Expected<RgbdFrame> FrameAssembler::from_images(const FrameMessages& messages) {
  if (auto fits = check_registration(messages, options_.depth_is_registered); !fits) {
    return tl::unexpected(fits.error());
  }
  auto color = decoded<ColorImage>(*messages.part(FramePart::color),
                                   [](const auto& message) { return color_of(message); });
  if (!color) return tl::unexpected(color.error());
  auto depth = decoded<DepthImage>(*messages.part(FramePart::depth),
                                   [](const auto& message) { return depth_of(message); });
  if (!depth) return tl::unexpected(depth.error());
  if (!same_shape(color->width(), color->height(), depth->width(), depth->height())) {
    return fail("colour is " + size_text(color->width(), color->height()) + ", depth " +
                size_text(depth->width(), depth->height()) +
                ": have the driver register depth to colour (RealSense: align_depth.enable)");
  }
  const auto color_model =
      model(*messages.info, color->width(), color->height(), options_.color_is_raw);
  if (!color_model) return tl::unexpected(color_model.error());
  const auto depth_model =
      model(*messages.info, depth->width(), depth->height(), options_.depth_is_raw);
  if (!depth_model) return tl::unexpected(depth_model.error());

  const int width = std::min(color->width(), depth->width());
  const int height = std::min(color->height(), depth->height());
  RgbdFrame frame;
  frame.intrinsics = scaled(depth_model->intrinsics, width, height);
  frame.color = resized(without_lens(std::move(*color), *color_model, Rgb{}), width, height);
  frame.depth = resized(without_lens(std::move(*depth), *depth_model, 0.0F), width, height);
  return frame;
}

Expected<RgbdFrame> FrameAssembler::from_cloud(const FrameMessages& messages) {
  const auto* const cloud = std::get_if<sensor_msgs::PointCloud2>(messages.part(FramePart::points));
  if (cloud == nullptr) return fail("an image where a cloud was expected");
  auto images = images_of(*cloud);
  if (!images) return tl::unexpected(images.error());
  if (images->color.empty()) {
    return fail(
        "the cloud has no colours (field rgb), which detectors need: have the driver add "
        "them, or give color, depth and info in place of points");
  }
  if (!images->intrinsics) {
    return fail("the cloud has too few points to tell the camera's focal length");
  }
  RgbdFrame frame;
  frame.intrinsics = *images->intrinsics;
  frame.depth = std::move(images->depth);
  frame.color = std::move(images->color);
  return frame;
}

Expected<void> FrameAssembler::add_labels(const FrameMessages& messages, RgbdFrame& frame) {
  auto labels = decoded<Image<PixelLabel>>(*messages.part(FramePart::labels),
                                           [](const auto& message) { return labels_of(message); });
  if (!labels) return tl::unexpected(labels.error());
  const int width = frame.depth.width(), height = frame.depth.height();
  if (!same_shape(labels->width(), labels->height(), width, height)) {
    return fail("labels are " + size_text(labels->width(), labels->height()) + ", the frame " +
                size_text(width, height) + ": they must show what the colour image shows");
  }
  if (const PartMessage* const part = messages.part(FramePart::confidences)) {
    const auto* const image = std::get_if<sensor_msgs::Image>(part);
    if (image == nullptr) return fail("confidences must be an image that is not compressed");
    const auto sure = confidences_of(*image);
    if (!sure) return tl::unexpected(sure.error());
    if (sure->width() != labels->width() || sure->height() != labels->height()) {
      return fail("confidences are " + size_text(sure->width(), sure->height()) + ", labels " +
                  size_text(labels->width(), labels->height()));
    }
    for (std::size_t i = 0; i < labels->pixels().size(); ++i) {
      if (static_cast<double>(sure->pixels()[i]) < options_.min_confidence) {
        labels->pixels()[i] = PixelLabel::background;
      }
    }
  }
  if (messages.part(FramePart::points) == nullptr) {
    const auto lens =
        model(*messages.info, labels->width(), labels->height(), options_.color_is_raw);
    if (!lens) return tl::unexpected(lens.error());
    *labels = without_lens(std::move(*labels), *lens, PixelLabel::background);
  }
  frame.labels = resized(std::move(*labels), width, height);
  return {};
}

Expected<RgbdFrame> FrameAssembler::assemble(const FrameMessages& messages) {
  auto frame =
      messages.part(FramePart::points) != nullptr ? from_cloud(messages) : from_images(messages);
  if (!frame) return frame;
  frame->intrinsics.min_range_m = options_.min_range_m;
  frame->intrinsics.max_range_m = options_.max_range_m;
  keep_range(frame->depth, options_.min_range_m, options_.max_range_m);
  if (messages.part(FramePart::labels) != nullptr) {
    if (auto added = add_labels(messages, *frame); !added) return tl::unexpected(added.error());
  }
  return frame;
}

}  // namespace canopeer::ros
