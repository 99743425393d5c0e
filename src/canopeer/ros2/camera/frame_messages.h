#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/ros2/time/stamp.h"

namespace canopeer::ros {

/// What a frame is made of. Depth, or points in place of depth and colour, says when it was taken.
enum class FramePart { depth, points, color, labels, confidences };
inline constexpr std::size_t kFrameParts = 5;
[[nodiscard]] constexpr std::string_view name_of(FramePart part) {
  constexpr std::array<std::string_view, kFrameParts> kNames = {"depth", "points", "color",
                                                                "labels", "confidences"};
  return kNames[static_cast<std::size_t>(part)];
}

using PartMessage =
    std::variant<sensor_msgs::Image, sensor_msgs::CompressedImage, sensor_msgs::PointCloud2>;
[[nodiscard]] inline const std_msgs::Header& header_of(const PartMessage& message) {
  return std::visit([](const auto& m) -> const std_msgs::Header& { return m.header; }, message);
}
/// What it holds in memory, texts and fields included.
[[nodiscard]] std::size_t octets_of(const PartMessage& message);

/// Messages that belong together, not looked into yet.
struct FrameMessages {
  Stamp stamp = 0;                                                    ///< by the camera's clock
  std::chrono::steady_clock::time_point arrived{};                    ///< the last of them
  std::array<std::shared_ptr<const PartMessage>, kFrameParts> parts;  ///< null: not asked for
  std::shared_ptr<const sensor_msgs::CameraInfo> info;                ///< null: none came yet

  [[nodiscard]] const PartMessage* part(FramePart which) const {
    return parts[static_cast<std::size_t>(which)].get();
  }
};

}  // namespace canopeer::ros
