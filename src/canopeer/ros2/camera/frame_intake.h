#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/ros2/camera/clock_difference.h"
#include "canopeer/ros2/camera/frame_messages.h"
#include "canopeer/ros2/camera/frame_sync.h"

namespace canopeer::ros {

struct FrameIntakeOptions {
  std::vector<FramePart> parts;  ///< what a frame needs; depth or points comes first
  bool needs_info = true;        ///< frames without a camera info are not given out
  FrameSyncOptions sync;
  std::size_t max_kept = 24;  ///< frames that nobody asked for yet; the oldest goes
  std::size_t max_kept_octets = 128u << 20;
};

/// Joins image messages as they come in and keeps the last ones, not decoded: a mission looks into
/// few of them. Thread-safe.
class FrameIntake {
 public:
  using Steady = std::chrono::steady_clock;

  explicit FrameIntake(FrameIntakeOptions options);

  /// `now`: ROS time by our clock.
  void add(FramePart part, PartMessage message, Stamp now);
  void set_info(sensor_msgs::CameraInfo info);

  /// The newest frame if its stamp is `from` or later; waits for one until then.
  [[nodiscard]] std::shared_ptr<const FrameMessages> wait_for(Stamp from, Steady::time_point until);
  /// Those kept with stamps after `stamp`, by time.
  [[nodiscard]] std::vector<std::shared_ptr<const FrameMessages>> after(Stamp stamp) const;

  /// What came of a part.
  struct Heard {
    std::int64_t count = 0;
    std::int64_t without_stamp = 0;  ///< stamp 0: dropped
    std::optional<Steady::time_point> last;
    std::optional<Stamp> newest;        ///< stamp
    std::string frame_id;               ///< of the last one
    std::string encoding;               ///< of the last one; of clouds empty
    std::size_t octets = 0;             ///< of the last one
    std::optional<double> least_age_s;  ///< see ClockDifference
  };
  [[nodiscard]] Heard heard(FramePart part) const;
  [[nodiscard]] std::optional<sensor_msgs::CameraInfo> info() const;
  /// Frames joined; messages that found no partners.
  [[nodiscard]] std::int64_t joined() const;
  [[nodiscard]] std::int64_t dropped() const;
  [[nodiscard]] const FrameIntakeOptions& options() const { return options_; }

 private:
  using Message = std::shared_ptr<const PartMessage>;
  void keep(FrameSync<Message>::Set&& set);

  const FrameIntakeOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  FrameSync<Message> sync_;
  std::deque<std::shared_ptr<const FrameMessages>> kept_;  // by time
  std::size_t kept_octets_ = 0;
  std::shared_ptr<const sensor_msgs::CameraInfo> info_;
  std::array<Heard, kFrameParts> heard_;
  std::array<ClockDifference, kFrameParts> ages_;
  std::int64_t joined_ = 0;
};

}  // namespace canopeer::ros
