#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "canopeer/scene/scene.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// A part, world frame, and numbers of its triangles.
struct NumberedPart {
  ScenePart part;
  /// One per triangle, or empty: none has a number.
  std::vector<std::uint32_t> numbers;

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
};

/// Which numbers a pinhole camera sees: what Renderer shows, without depth, colour and labels. For
/// those who look thousands of times at the same few metres.
class NumberedView {
 public:
  explicit NumberedView(const std::vector<NumberedPart>& parts);
  ~NumberedView();
  NumberedView(NumberedView&&) noexcept;
  NumberedView& operator=(NumberedView&&) noexcept;

  /// Replaces `numbers` by those that a pixel's centre or more shows, ascending, each once; only
  /// where the depth along the axis is in the camera's range. Thread-safe; the result depends on
  /// the arguments only.
  void see(const CameraIntrinsics& camera, const Pose& T_world_camera,
           std::vector<std::uint32_t>& numbers) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
